#include "renderer/view/effort_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "renderer/base/number_text.h"
#include "renderer/measure/error_curve.h"
#include "renderer/measure/metrics.h"
#include "renderer/view/estimator_look.h"

namespace quartet {
namespace {

constexpr Rgba8 text_color{200, 205, 212, 255};
constexpr Rgba8 floor_color{236, 110, 124, 255};

/// Where a logarithmic chart can show them.
std::vector<glm::dvec2> curve_of(const LaneSnapshot& lane, const Snapshot& snapshot,
                                 Effort effort) {
  std::vector<glm::dvec2> points;
  for (const PassRecord& record : lane.history) {
    const double x = effort_row(effort).of(record, snapshot.pixels());
    const double y = record.truth.error;
    if (x > 0.0 && y > 0.0 && std::isfinite(y)) {
      points.emplace_back(x, y);
    }
  }
  return points;
}

bool is_logarithmic(const Metric& row) {
  return row.scale != MetricScale::decibels;
}

struct Extent {
  double low = INFINITY;
  double high = 0.0;

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Axis vertical_axis(const Metric& row, const Extent& extent) {
  std::string label(row.label);
  if (!row.unit.empty()) {
    label += fmt::format(" ({})", row.unit);
  }
  return is_logarithmic(row)
             ? log_axis(extent.low / 1.2, extent.high * 1.2, label, 5)
             : linear_axis(std::floor(extent.low), std::ceil(extent.high), label, 5);
}

Line line_of(std::vector<glm::dvec2> points, EstimatorId estimator, int id) {
  const EstimatorLook& look = look_of(estimator);
  Line line;
  line.label = std::string(quartet::estimator(estimator).label);
  line.color = look.screen;
  line.dash = look.dash;
  line.shape = look.shape;
  line.points = std::move(points);
  line.dots = line.points.size() <= 32;
  line.id = id;
  return line;
}

}  // namespace

Chart effort_chart(const Snapshot& snapshot, const EffortChart& what) {
  const Metric& row = metric(snapshot.metric);
  Chart chart;
  chart.title = fmt::format("{} against {}", row.label, effort_row(what.effort).label);
  Extent x;
  Extent y;
  const auto add = [&](Line line) {
    for (const glm::dvec2& point : line.points) {
      x.include(point.x);
      y.include(point.y);
    }
    if (!line.points.empty()) {
      chart.lines.push_back(std::move(line));
    }
  };
  if (snapshot.baseline) {
    add(line_of(curve_of(*snapshot.baseline, snapshot, what.effort), EstimatorId::uniform, -1));
  }
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    const LaneSnapshot& lane = snapshot.lanes[i];
    const EstimatorId id = lane.settings.estimator;
    Line line = line_of(curve_of(lane, snapshot, what.effort), id, int(i));
    for (std::size_t before = 0; before < i; ++before) {
      line.dash = snapshot.lanes[before].settings.estimator == id ? Dash::dotted : line.dash;
    }
    add(std::move(line));
  }
  if (chart.lines.empty()) {
    chart.x = log_axis(0.1, 10.0, std::string(effort_row(what.effort).label), 5);
    chart.y = vertical_axis(row, {1e-3, 1.0});
    const bool no_rays = what.effort == Effort::rays && snapshot.baseline &&
                         !snapshot.baseline->history.empty() &&
                         snapshot.baseline->history.back().rays == 0;
    chart.texts.push_back(
        {{0.5, 0.55},
         Align::center,
         no_rays ? "samples that are drawn, not traced, take no rays" : "no errors yet",
         text_color});
    return chart;
  }
  if (snapshot.baseline) {
    chart.texts.push_back({{0.99, 0.97}, Align::right, "white: uniform sampling", text_color});
  }
  if (what.noise_floor && (!is_logarithmic(row) || *what.noise_floor > 0.0)) {
    y.include(*what.noise_floor);
    chart.levels.push_back(
        {fmt::format("noise floor of the reference {}", format_number(*what.noise_floor)),
         floor_color, *what.noise_floor});
  }
  chart.x = log_axis(x.low / 1.05, x.high * 1.05, std::string(effort_row(what.effort).label), 6);
  chart.y = vertical_axis(row, y);
  return chart;
}

std::optional<double> baseline_error(const Snapshot& snapshot, Effort effort, double at) {
  if (!snapshot.baseline || !(at > 0.0) || !is_logarithmic(metric(snapshot.metric))) {
    return std::nullopt;
  }
  std::vector<ErrorCurve::Point> measured;
  for (const glm::dvec2& point : curve_of(*snapshot.baseline, snapshot, effort)) {
    measured.push_back({point.x, point.y});
  }
  const double error = ErrorCurve(std::move(measured)).error_at(at);
  return std::isnan(error) ? std::nullopt : std::optional(error);
}

std::optional<double> times_uniform(const Snapshot& snapshot, std::size_t lane, Effort effort) {
  const LaneSnapshot& shown = snapshot.lanes[lane];
  if (shown.history.empty() || !(shown.history.back().truth.error > 0.0)) {
    return std::nullopt;
  }
  const PassRecord& last = shown.history.back();
  const auto uniform =
      baseline_error(snapshot, effort, effort_row(effort).of(last, snapshot.pixels()));
  return uniform ? std::optional(*uniform / last.truth.error) : std::nullopt;
}

}  // namespace quartet
