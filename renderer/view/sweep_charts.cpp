#include "renderer/view/sweep_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/base/number_text.h"

namespace quartet {
namespace {

constexpr Rgba8 sweep_baseline_color{70, 70, 70};
constexpr Rgba8 sweep_floor_color{150, 60, 60};
constexpr Rgba8 front_color{222, 214, 190};
constexpr int ticks = 9;

struct Range {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void include(double value) {
    if (std::isfinite(value)) {
      min = std::min(min, value);
      max = std::max(max, value);
    }
  }
};

using Cost = double SweepPoint::*;

std::string error_label(const Metric& metric) {
  return fmt::format("{}{}{}", metric.label, metric.unit.empty() ? "" : ", ", metric.unit);
}

/// Over the points that lie inside of the other axis.
Axis error_axis(const SweepSummary& summary, const Axis& costs, Cost cost) {
  Range range;
  for (const auto* points : {&summary.points, &summary.uniform}) {
    for (const SweepPoint& point : *points) {
      const double position = axis_position(costs, point.*cost);
      if (position >= 0.0 && position <= 1.0) {
        range.include(point.error_low);
        range.include(point.error_high);
      }
    }
  }
  const Metric& row = metric(summary.metric);
  if (row.scale == MetricScale::decibels) {
    return linear_axis(range.min, range.max, error_label(row), ticks);
  }
  // A noise floor far below all errors says that it is far below, wherever it is drawn.
  constexpr double far = 20.0;
  if (summary.noise_floor > range.min / far) {
    range.include(summary.noise_floor);
  }
  return log_axis(0.9 * range.min, 1.1 * range.max, error_label(row), ticks);
}

glm::dvec2 place(const SweepPoint& point, Cost cost) {
  return {point.*cost, point.error};
}

void add_baseline(const SweepSummary& summary, Cost cost, Chart& chart) {
  Line line{.label = "uniform", .color = sweep_baseline_color, .points = {}, .dash = Dash::dashed};
  for (const SweepPoint& point : summary.uniform) {
    line.points.push_back(place(point, cost));
  }
  chart.lines.push_back(std::move(line));
}

void add_lanes(const SweepSummary& summary, Cost cost, Chart& chart) {
  std::size_t color = 0;
  for (std::size_t begin = 0; begin < summary.points.size();) {
    const EstimatorId id = summary.points[begin].settings.estimator;
    std::size_t end = begin;
    Line line{.label = std::string(estimator(id).label),
              .color = paper_color(color++),
              .points = {},
              .dots = true};
    Band band{.label = fmt::format("lowest to highest of {} seeds", summary.seeds),
              .color = line.color,
              .lower = {},
              .upper = {}};
    band.color.a = 45;
    // By rising thresholds: a lane comes again only after its highest.
    for (; end < summary.points.size() && summary.points[end].settings.estimator == id &&
           (end == begin || summary.points[end].factor > summary.points[end - 1].factor);
         ++end) {
      const SweepPoint& point = summary.points[end];
      line.points.push_back(place(point, cost));
      band.lower.emplace_back(point.*cost, point.error_low);
      band.upper.emplace_back(point.*cost, point.error_high);
      if (point.factor == 1.0 && estimator(id).channels > 0) {
        chart.marks.push_back(
            {"default threshold", line.color, place(point, cost), MarkShape::diamond});
      }
    }
    chart.lines.push_back(std::move(line));
    if (summary.seeds > 1) {
      chart.bands.push_back(std::move(band));
    }
    begin = end;
  }
}

Chart sweep_chart(const SweepSummary& summary, Cost cost, std::string title, std::string x_label) {
  Chart chart;
  chart.title = std::move(title);
  Range costs;
  for (const SweepPoint& point : summary.points) {
    costs.include(point.*cost);
  }
  // The baseline only around what it is compared with, and whole if there is nothing else.
  for (const SweepPoint& point : summary.uniform) {
    if (summary.points.empty() || &point == &summary.uniform.back()) {
      costs.include(point.*cost);
    }
  }
  chart.x = log_axis(0.9 * costs.min, 1.1 * costs.max, std::move(x_label), ticks);
  chart.y = error_axis(summary, chart.x, cost);
  if (cost == &SweepPoint::seconds) {
    Line front{.label = "Pareto front", .color = front_color, .points = {}, .width = 5.0f};
    for (const SweepPoint& point : summary.front) {
      front.points.push_back(place(point, cost));
    }
    chart.lines.push_back(std::move(front));
  }
  add_baseline(summary, cost, chart);
  add_lanes(summary, cost, chart);
  if (summary.noise_floor > 0.0) {
    chart.levels.push_back(
        {fmt::format("noise floor of the reference, {}", format_number(summary.noise_floor)),
         sweep_floor_color, summary.noise_floor});
  }
  return chart;
}

}  // namespace

SweepSummary summarize(const SweepResult& result, const SweepPlan& plan, std::size_t metric,
                       double noise_floor) {
  SweepSummary summary;
  summary.points = sweep_points(result, plan, metric);
  summary.uniform = uniform_points(result, metric);
  std::vector<SweepPoint> all = summary.points;
  all.insert(all.end(), summary.uniform.begin(), summary.uniform.end());
  summary.metric = plan.metrics[metric];
  summary.front = pareto_front(std::move(all), quartet::metric(summary.metric).higher_is_better);
  summary.seeds = plan.seeds;
  summary.noise_floor = noise_floor;
  return summary;
}

std::vector<Chart> sweep_charts(const SweepSummary& summary) {
  std::vector<Chart> charts{sweep_chart(summary, &SweepPoint::seconds, "Error against time",
                                        "as-if-alone time, seconds")};
  // Samples that are drawn from a distribution take no rays.
  if (summary.uniform.back().mean_rays > 0.0) {
    charts.push_back(
        sweep_chart(summary, &SweepPoint::mean_rays, "Error against rays", "mean rays per pixel"));
  }
  charts.push_back(sweep_chart(summary, &SweepPoint::mean_spp, "Error against samples",
                               "mean samples per pixel"));
  return charts;
}

Chart calibration_chart(const SweepResult& result) {
  Chart chart;
  chart.title = "True error against estimated error";
  Range x;
  Range y;
  std::size_t color = 0;
  for (const SweepRun& run : result.runs) {
    if (run.factor != 1.0 || run.seed != result.first_seed) {
      continue;
    }
    Line line{.label = std::string(estimator(run.settings.estimator).label),
              .color = paper_color(color++),
              .points = {},
              .dots = true};
    for (const CalibrationBin& bin : run.quality.calibration) {
      if (bin.estimated > 0.0 && bin.true_squared_error > 0.0) {
        line.points.emplace_back(bin.estimated, bin.true_squared_error);
        x.include(bin.estimated);
        y.include(bin.true_squared_error);
      }
    }
    chart.lines.push_back(std::move(line));
  }
  chart.x = log_axis(x.min, x.max, "estimated error, in units of the threshold", ticks);
  chart.y = log_axis(y.min, y.max, "mean true squared error, radiance²", ticks);
  return chart;
}

Rgba8 paper_color(std::size_t line) {
  constexpr std::array colors{Rgba8{31, 119, 180}, Rgba8{230, 110, 0},  Rgba8{44, 150, 44},
                              Rgba8{214, 39, 40},  Rgba8{130, 80, 180}, Rgba8{140, 86, 75},
                              Rgba8{220, 90, 180}, Rgba8{23, 175, 195}, Rgba8{160, 160, 20},
                              Rgba8{20, 60, 110},  Rgba8{0, 110, 90},   Rgba8{120, 0, 60},
                              Rgba8{150, 150, 150}};
  return colors[line % colors.size()];
}

}  // namespace quartet
