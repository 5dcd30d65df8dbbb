#pragma once

#include <optional>

#include "ui/window/lab_frame.h"

namespace quartet {

/// A row a lane and one for uniform sampling: samples, seconds, what the metrics say, efficiency
/// against uniform sampling. As many metrics as there is room for, the chosen one first.
void draw_metric_table(LabFrame& frame, const ScreenRect& box);

/// Of the reference; none if it has none or it is not known yet.
std::optional<double> noise_floor(const LabFrame& frame, MetricId key);

}  // namespace quartet
