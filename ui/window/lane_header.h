#pragma once

#include "ui/window/lab_frame.h"

namespace quartet {

/// A lane's controls and numbers: estimator, policy, thresholds, mean and highest spp, seconds,
/// share of pixels not done. Wide enough, it takes fewer lines.
float lane_header_height(const Ui& ui, float width);
void draw_lane_header(LabFrame& frame, std::size_t lane, ScreenRect box);

/// Where a threshold slider of this estimator ends; numbers beyond can be typed.
struct ThresholdRange {
  float low, high;
};
ThresholdRange threshold_range(const Estimator& row, std::size_t channel);

/// Whether the mouse holds one of the lane's thresholds there.
bool holds_threshold(const Ui& ui, std::size_t lane);

}  // namespace quartet
