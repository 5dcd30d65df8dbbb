#include "renderer/adaptive/estimators/estimator_rows.h"

namespace quartet {

constexpr Estimator uniform_estimator{
    .key = EstimatorId::uniform,
    .id = "uniform",
    .label = "uniform",
    .unit = "",
    .source = "every pixel alike: the baseline of every comparison",
    .threshold_source = "",
    .channels = 0,
    .default_thresholds = {},
    .estimate = nullptr,
    .default_policy = PolicyId::vote};

}  // namespace quartet
