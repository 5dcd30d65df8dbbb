#pragma once

#include <functional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "renderer/study/stability/trial.h"

namespace quartet {

struct StabilityOptions {
  std::vector<const FailureCase*> cases;
  std::vector<EstimatorId> estimators;   ///< those with an error, to be studied
  PolicyId policy = PolicyId::batch;     ///< on the terms of the budget; one that ends: not vote
  SamplerId sampler = SamplerId::sobol;  ///< where light is traced
  std::uint32_t seeds = 16;              ///< at least 2
  double spp = 16.0;                     ///< the common budget, mean samples a pixel
  std::uint32_t window_passes = 15;      ///< on the terms of the window
  TruthEffort truth;
  std::uint32_t oracle_runs = 32;  ///< that tell the oracle which errors to expect
  std::uint32_t audit_samples = 8192;
  double audit_share = 1.0 / 32.0;
};

/// What came of all trials of a case.
struct CaseResult {
  const FailureCase* failure = nullptr;
  Truth truth;
  int width = 0, height = 0;
  double limit = 0.0;                    ///< as in Judgement
  SamplerId sampler = SamplerId::sobol;  ///< of the trials
  std::vector<Subject> subjects;         ///< with the thresholds that they had for the budget
  std::vector<Trial> trials;
};

/// Runs the study, one case after the other, each with seeds side by side on all processors of the
/// current TBB arena. `progress` is called from any of its threads, one at a time, with the share
/// that is done and what is being worked on. Empty if `stop` ended it early. Depends on nothing but
/// the options, times aside.
std::vector<CaseResult> run_stability(const StabilityOptions& options,
                                      const std::function<void(double, std::string_view)>& progress,
                                      std::stop_token stop = {});

}  // namespace quartet
