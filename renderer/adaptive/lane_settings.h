#pragma once

#include <cstdint>

#include "renderer/adaptive/estimators/estimator.h"
#include "renderer/adaptive/policies/policy.h"
#include "renderer/adaptive/sample_mode.h"

namespace quartet {

/// What decides where a lane's samples go. A change replays the lane from its first pass.
struct LaneSettings {
  EstimatorId estimator = EstimatorId::contrast;
  Thresholds thresholds = quartet::estimator(EstimatorId::contrast).default_thresholds;
  Policy policy;
  std::uint32_t max_spp = 1u << 16;  ///< at most most_spp
  SampleMode mode = SampleMode::reuse;
  bool operator==(const LaneSettings&) const = default;
};

/// More samples than this no pixel can have: indices of samples are also counted with a sign.
inline constexpr std::uint32_t most_spp = (1u << 31) - 1;

/// Settings with an estimator's default thresholds and policy.
LaneSettings default_settings(EstimatorId estimator);

/// Samples below which no pixel is done, whatever its error: as the estimator has it.
std::uint32_t minimum_samples(const LaneSettings& settings);

}  // namespace quartet
