#pragma once

#include <vector>

#include "renderer/image/chart.h"
#include "renderer/measure/quality.h"

namespace quartet {

/// What a lane's errors say of the true ones.
struct LaneQuality {
  std::vector<CalibrationBin> calibration;  ///< against errors in units of the threshold
  double rank_correlation = 0.0;            ///< Spearman's; NaN where there is none
  FalseStops stops;
};

/// True squared error over estimated error, log–log: a point for each group of pixels that the
/// estimator finds about equally wrong. What rises is good; beyond the threshold, shaded, no pixel
/// is done. Says the rank correlation and the share of false stops. Empty, with a text that
/// says so, for an estimator without errors.
Chart quality_chart(const LaneQuality& quality, std::string title, Rgba8 accent);

}  // namespace quartet
