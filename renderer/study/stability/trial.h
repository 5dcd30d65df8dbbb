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

namespace quartet {

/// How a trial's thresholds were chosen.
enum class Tuning {
  usual,   ///< the estimator's defaults
  budget,  ///< the multiple of them at which it takes the common budget
};

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
  Tuning tuning = Tuning::usual;
  Variation variation = Variation::none;
  std::uint64_t seed = 0;
  LaneSettings settings;
  std::uint32_t passes = 0;
  Outcome outcome;
  RejectedCount rejected;
};

/// What all trials of a case have in common. Policies must come to an end (not vote).
struct TrialSetup {
  const FailureCase* failure = nullptr;
  std::shared_ptr<const TraceScene> scene;
  RenderSettings settings;
  Truth truth;
  std::shared_ptr<const Audit> audit;
  double target = 0.0;               ///< squared relative error above which a pixel is wrong
  LaneSettings uniform;              ///< what the others are compared with
  LaneSettings oracle;               ///< at the budget
  std::vector<LaneSettings> usual;   ///< one an estimator
  std::vector<LaneSettings> budget;  ///< the same
};

/// All trials with the `seed`th seed: the plain experiment, and with the first few seeds its
/// variations. Nothing if `stop` ended it early.
std::optional<std::vector<Trial>> run_trials(const TrialSetup& setup, std::uint32_t seed,
                                             const std::stop_token& stop);

}  // namespace quartet
