#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string_view>
#include <vector>

#include "renderer/adaptive/lane_settings.h"
#include "renderer/measure/rejected_count.h"
#include "renderer/study/stability/outcome.h"
#include "renderer/study/stability/subject.h"

namespace quartet {

/// What is different from the plain experiment, to see how much that changes.
enum class Variation { none, threshold_up, threshold_down, exposure, resolution };

/// One row of the table of variations.
struct VariationRow {
  Variation key;
  std::string_view id;
  std::string_view description;
};
std::span<const VariationRow> variations();

/// One lane, run to its end.
struct Trial {
  const FailureCase* failure = nullptr;
  std::string_view subject;  ///< its id
  Terms terms = Terms::budget;
  Variation variation = Variation::none;
  std::uint64_t seed = 0;
  LaneSettings settings;
  std::uint32_t passes = 0;
  Outcome outcome;
  RejectedCount rejected;
};

/// What all trials of a case have in common.
struct TrialSetup {
  const FailureCase* failure = nullptr;
  std::shared_ptr<const TraceScene> scene;
  RenderSettings settings;
  Judgement judgement;
  std::shared_ptr<const Audit> audit;
  /// On the terms of the budget, with thresholds that meet it as far as they can.
  std::vector<Subject> subjects;
  std::uint32_t window_passes = 0;  ///< on the terms of the window
  std::uint32_t most_spp = 0;       ///< that a pixel may have on the terms of the budget
};

/// All trials with the `seed`th seed: every subject on the terms of the budget, of what is studied
/// also the unbiased twin and, with the first few seeds, variations; all but planted mistakes on
/// the terms of the window. Nothing if `stop` ended it early.
std::optional<std::vector<Trial>> run_trials(const TrialSetup& setup, std::uint32_t seed,
                                             const std::stop_token& stop);

}  // namespace quartet
