#include "renderer/image/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quartet {
namespace {

/// The value of a line at x, between its points; NaN beyond them.
double value_at(const Line& line, double x) {
  const auto right = std::ranges::lower_bound(line.points, x, {}, &glm::dvec2::x);
  if (right == line.points.end()) {
    return std::nan("");
  }
  if (right == line.points.begin()) {
    return right->x == x ? right->y : std::nan("");
  }
  const glm::dvec2 left = *(right - 1);
  return glm::mix(left.y, right->y, (x - left.x) / (right->x - left.x));
}

}  // namespace

double axis_position(const Axis& axis, double value) {
  if (axis.spacing == Spacing::linear) {
    return (value - axis.min) / (axis.max - axis.min);
  }
  constexpr double below = -1.0;
  return value > 0.0 ? std::max(below, std::log(value / axis.min) / std::log(axis.max / axis.min))
                     : below;
}

double axis_value(const Axis& axis, double position) {
  return axis.spacing == Spacing::linear ? axis.min + position * (axis.max - axis.min)
                                         : axis.min * std::pow(axis.max / axis.min, position);
}

std::string reading_at(const Chart& chart, double x) {
  std::string text;
  const auto add = [&](const std::string& name, double value) {
    text += fmt::format("{}{}{}", text.empty() ? "" : "\n", name, format_number(value));
  };
  for (const Bar& bar : chart.bars) {
    if (x >= bar.begin && x < bar.end) {
      add(fmt::format("{} {} to {}, {}: ", chart.x.label, format_number(bar.begin),
                      format_number(bar.end), chart.y.label),
          bar.value);
    }
  }
  for (const Line& line : chart.lines) {
    if (const double value = value_at(line, x); !std::isnan(value)) {
      add(fmt::format("{} {}, {}: ", chart.x.label, format_number(x),
                      line.label.empty() ? chart.y.label : line.label),
          value);
    }
  }
  return text;
}

const Marker* marker_near(const Chart& chart, double position, double reach) {
  const Marker* nearest = nullptr;
  for (const Marker& marker : chart.markers) {
    const double distance = std::abs(axis_position(chart.x, marker.value) - position);
    if (distance <= reach) {
      nearest = &marker;
      reach = distance;
    }
  }
  return nearest;
}

Axis linear_axis(double min, double max, std::string label, int wanted_ticks) {
  Axis axis;
  axis.min = min;
  axis.max = max > min ? max : min + 1.0;
  axis.label = std::move(label);
  axis.ticks = linear_ticks(axis.min, axis.max, wanted_ticks);
  return axis;
}

Axis decade_axis(int first, int last, std::string label) {
  Axis axis;
  axis.min = std::pow(10.0, first);
  axis.max = std::pow(10.0, last);
  axis.spacing = Spacing::logarithmic;
  axis.label = std::move(label);
  axis.ticks = decade_ticks(first, last);
  return axis;
}

}  // namespace quartet
