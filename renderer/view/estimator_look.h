#pragma once

#include "renderer/adaptive/estimators/estimator.h"
#include "renderer/view/chart.h"

namespace quartet {

/// How an estimator is drawn, everywhere the same: colours after Okabe and Ito, "Color Universal
/// Design" (2008), and a mark and a dash of its own for those who cannot tell colours apart.
struct EstimatorLook {
  Rgba8 paper;   ///< dark enough for white paper
  Rgba8 screen;  ///< the same hue, bright enough for the window's dark ground
  MarkShape shape = MarkShape::dot;
  Dash dash = Dash::solid;
};

const EstimatorLook& look_of(EstimatorId estimator);

}  // namespace quartet
