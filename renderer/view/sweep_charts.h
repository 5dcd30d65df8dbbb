#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/study/sweep.h"
#include "renderer/view/chart.h"

namespace quartet {

/// What a sweep's charts show, worked out once.
struct SweepSummary {
  std::vector<SweepPoint> points;   ///< of all lanes
  std::vector<SweepPoint> uniform;  ///< the baseline, by rising passes
  std::vector<SweepPoint> front;    ///< of points and uniform
  MetricId metric = default_metric;
  std::uint32_t seeds = 1;
  double noise_floor = 0.0;  ///< of the reference; NaN: not known
};
SweepSummary summarize(const SweepResult& result, const SweepPlan& plan, std::size_t metric,
                       double noise_floor);

/// Error against as-if-alone seconds, mean rays and mean samples per pixel, on logarithmic axes: a
/// line a lane through its thresholds with a band from the lowest to the highest seed, the
/// default threshold marked, the uniform baseline dashed, as it was measured, and the reference's
/// noise floor. In colours for paper.
std::vector<Chart> sweep_charts(const SweepSummary& summary);

/// What an estimator is worth pixel by pixel: mean true squared error against the estimated one in
/// units of the threshold, at the default thresholds with the first seed. One that knew the truth
/// would give a line of slope 1 or 2.
Chart calibration_chart(const SweepResult& result);

/// Colours that can be told apart on white paper, one a line; they repeat after thirteen.
Rgba8 paper_color(std::size_t line);

}  // namespace quartet
