#include "renderer/adaptive/estimators/estimator_rows.h"

namespace quartet {

constexpr Estimator uniform_clamp_estimator{
    .key = EstimatorId::uniform_clamp,
    .id = "uniform-clamp",
    .label = "uniform, clamped",
    .unit = "",
    .source =
        "every pixel alike, each channel of a sample cut at 4, unless the pixel's first two "
        "samples are above it: the baseline that is too dark, and wins in relMSE",
    .threshold_source = "",
    .channels = 0,
    .default_thresholds = {},
    .estimate = nullptr,
    .default_policy = PolicyId::vote,
    .needs = {.clamp = 4.0f}};

}  // namespace quartet
