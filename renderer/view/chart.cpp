#include "renderer/view/chart.h"
#include "renderer/base/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quartet {
namespace {

/// The value of a line at x, between its points; NaN beyond them. A line that turns back has the
/// value of its first piece there.
double value_at(const Chart& chart, const Line& line, double x) {
  const double position = axis_position(chart.x, x);
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const glm::dvec2 here = line.points[i];
    if (here.x == x) {
      return here.y;
    }
    if (i == 0 || (line.points[i - 1].x < x) == (here.x < x)) {
      continue;
    }
    const glm::dvec2 before = line.points[i - 1];
    const double begin = axis_position(chart.x, before.x);
    const double share = (position - begin) / (axis_position(chart.x, here.x) - begin);
    return axis_value(
        chart.y, glm::mix(axis_position(chart.y, before.y), axis_position(chart.y, here.y), share));
  }
  return std::nan("");
}

/// The largest 1, 2 or 5 times a power of ten that is not above the value.
double nice_below(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value) + 1e-12));
  const double fraction = value / power * (1.0 + 1e-12);
  return power * (fraction >= 5.0 ? 5.0 : fraction >= 2.0 ? 2.0 : 1.0);
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
    if (const double value = value_at(chart, line, x); !std::isnan(value)) {
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

Axis log_axis(double min, double max, std::string label, int wanted_ticks) {
  Axis axis;
  axis.spacing = Spacing::logarithmic;
  axis.label = std::move(label);
  const bool is_range = min > 0.0 && max >= min && std::isfinite(max);
  axis.min = is_range ? nice_below(min) : 0.1;
  // 1/x turns 1, 2, 5 into 1, 5, 2: what is below there is above here.
  axis.max = is_range ? 1.0 / nice_below(1.0 / max) : 1.0;
  if (axis.max <= axis.min * (1.0 + 1e-9)) {
    axis.max = 10.0 * axis.min;
  }
  axis.ticks = log_ticks(axis.min, axis.max, wanted_ticks);
  return axis;
}

}  // namespace quartet
