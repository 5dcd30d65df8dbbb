#include "renderer/adaptive/lane_settings.h"

namespace quartet {

std::uint32_t minimum_samples(const LaneSettings& settings) {
  const auto minimum = estimator(settings.estimator).minimum_samples;
  return minimum ? minimum(settings.thresholds) : 0;
}

LaneSettings default_settings(EstimatorId estimator_id) {
  LaneSettings settings;
  settings.estimator = estimator_id;
  const Estimator& row = estimator(estimator_id);
  settings.thresholds = row.default_thresholds;
  settings.policy.kind = row.default_policy;
  return settings;
}

}  // namespace quartet
