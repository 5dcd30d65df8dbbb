#pragma once

#include <string>

#include "renderer/measure/quality.h"
#include "renderer/view/chart.h"

namespace quartet {

/// True squared error over estimated error, log–log: a point for each group of pixels that the
/// estimator finds about equally wrong. What rises is good; beyond the threshold, shaded, no pixel
/// is done. Says the rank correlation and the share of false stops. Empty, with a text that
/// says so, for an estimator without errors.
Chart quality_chart(const EstimatorQuality& quality, std::string title, Rgba8 accent);

}  // namespace quartet
