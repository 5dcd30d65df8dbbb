#pragma once

#include <vector>

#include "renderer/study/sweep_points.h"
#include "renderer/view/chart.h"

namespace quartet {

// Charts of a sweep, in colours for paper. An axis of errors is logarithmic, but of decibels.

/// All estimators at their default thresholds, over the passes of their runs, and uniform sampling:
/// error, signed energy error and, if they are known, bias² and variance, against one effort. Each
/// line's label stands at its end.
std::vector<Chart> overview_charts(const SweepSummary& summary, Effort effort);

/// A small chart an estimator, all on the same axes: the error of each of its thresholds over the
/// passes, its unbiased twin at the default thresholds, uniform sampling, and the front over all.
std::vector<Chart> threshold_charts(const SweepSummary& summary, Effort effort);

/// What each estimator is worth pixel by pixel, all on the same axes: mean true squared error
/// against the estimated one in units of the threshold, at the default thresholds with the first
/// seed. One that knew the truth would give a line of slope 1 or 2.
std::vector<Chart> calibration_charts(const SweepResult& result);

}  // namespace quartet
