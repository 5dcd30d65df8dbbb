#include "renderer/view/needs_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/base/number_text.h"

namespace quartet {
namespace {

/// Colours that can be told apart on white paper, one a part; they repeat after thirteen.
Rgba8 part_color(std::size_t part) {
  constexpr std::array colors{Rgba8{31, 119, 180}, Rgba8{230, 110, 0},  Rgba8{44, 150, 44},
                              Rgba8{214, 39, 40},  Rgba8{130, 80, 180}, Rgba8{140, 86, 75},
                              Rgba8{220, 90, 180}, Rgba8{23, 175, 195}, Rgba8{160, 160, 20},
                              Rgba8{20, 60, 110},  Rgba8{0, 110, 90},   Rgba8{120, 0, 60},
                              Rgba8{150, 150, 150}};
  return colors[part % colors.size()];
}

constexpr Rgba8 limit_color{150, 60, 60};
constexpr Rgba8 smallest_color{0, 0, 0};
constexpr Rgba8 note_gray{70, 70, 70};
constexpr int needs_ticks = 8;
/// Errors this far below the limit need not be told apart.
constexpr double far_below = 1e-3;

using Ratio = double NeedsRow::*;

MarkShape shape_of(Need need) {
  switch (need) {
    case Need::needed:
      return MarkShape::diamond;
    case Need::not_needed:
      return MarkShape::dot;
    case Need::undecided:
      return MarkShape::cross;
  }
  return MarkShape::dot;
}

class NeedsChart {
 public:
  NeedsChart(const NeedsResult& result, const NeedsPlan& plan, Ratio ratio, std::string title,
             std::string x_label)
      : result_(result), ratio_(ratio) {
    chart_.title = std::move(title);
    double least = 1.0;
    double most = 1.0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = result.limit;
    for_each_row([&](const NeedsRow& row) {
      least = std::min(least, row.*ratio);
      most = std::max(most, row.*ratio);
      const Interval& error = row.measured.error;
      if (error.mean > 0.0) {
        lowest = std::min(lowest, error.mean);
      }
      highest = std::max({highest, error.mean, error.high});
    });
    // With nothing to be seen of the limit, as without noise, errors alone say how far to go.
    const double floor = result.limit > 0.0 ? far_below * result.limit : far_below * highest;
    const Metric& row = metric(plan.metric);
    chart_.x = log_axis(0.9 * least, 1.1 * most, std::move(x_label), needs_ticks);
    chart_.y = log_axis(
        std::max(floor, 0.5 * std::min(lowest, result.limit)), 1.2 * highest,
        fmt::format("error without it: {}{}{}", row.label, row.unit.empty() ? "" : ", ", row.unit),
        needs_ticks);
  }

  Chart build(bool asked) {
    if (result_.limit > 0.0) {
      chart_.levels.push_back(
          {fmt::format("{}, {}", asked ? "the error asked for" : "noise of the whole model",
                       format_number(result_.limit)),
           limit_color, result_.limit});
    }
    add_depths();
    std::size_t color = 1;
    for (const NeedsRow& row : result_.rows) {
      if (row.simplification.part != PartId::depth) {
        add_interval(row, part_color(color));
        add_mark(row, part_color(color), row.simplification.label);
        ++color;
      }
    }
    if (result_.smallest && result_.taken_out.size() > 1) {
      add_interval(*result_.smallest, smallest_color);
      add_mark(*result_.smallest, smallest_color, "the smallest model");
    }
    return std::move(chart_);
  }

 private:
  template <class Body>
  void for_each_row(const Body& body) const {
    std::ranges::for_each(result_.rows, body);
    if (result_.smallest) {
      body(*result_.smallest);
    }
  }

  double shown(double error) const { return std::max(error, chart_.y.min); }

  glm::dvec2 place(const NeedsRow& row) const {
    return {row.*ratio_, shown(row.measured.error.mean)};
  }

  void add_interval(const NeedsRow& row, Rgba8 color) {
    color.a = 150;
    const Interval& error = row.measured.error;
    chart_.lines.push_back(
        {.label = {},
         .color = color,
         .points = {{row.*ratio_, shown(error.low)}, {row.*ratio_, shown(error.high)}},
         .width = 0.7f});
  }

  void add_mark(const NeedsRow& row, Rgba8 color, std::string label) {
    chart_.marks.push_back({std::move(label), color, place(row), shape_of(row.need)});
  }

  void add_depths() {
    const Rgba8 color = part_color(0);
    Line line{.label = "depth", .color = color, .points = {}};
    for (const NeedsRow& row : result_.rows) {
      if (row.simplification.part == PartId::depth) {
        add_interval(row, color);
        add_mark(row, color, {});
        // Of several on the edge, which say no more than that, the first has a number.
        const bool on_edge = place(row).y <= chart_.y.min;
        const bool again = on_edge && !line.points.empty() && line.points.back().y <= chart_.y.min;
        line.points.push_back(place(row));
        if (again) {
          continue;
        }
        const glm::dvec2 at{axis_position(chart_.x, line.points.back().x),
                            axis_position(chart_.y, line.points.back().y)};
        // Numbers alone: that they are depths, the legend says. At the edge they stand above it.
        const std::string& label = row.simplification.label;
        chart_.texts.push_back({{at.x + 0.018, std::max(at.y + 0.02, 0.06)},
                                Align::left,
                                label.substr(label.find(' ') + 1),
                                note_gray});
      }
    }
    if (!line.points.empty()) {
      chart_.lines.push_back(std::move(line));
    }
  }

  const NeedsResult& result_;
  Ratio ratio_;
  Chart chart_;
};

}  // namespace

std::vector<Chart> needs_charts(const NeedsResult& result, const NeedsPlan& plan) {
  if (result.rows.empty()) {
    return {};
  }
  const bool asked = plan.error.has_value();
  return {NeedsChart(result, plan, &NeedsRow::rays_ratio, "Error against rays",
                     "rays a sample, over those of the whole model")
              .build(asked),
          NeedsChart(result, plan, &NeedsRow::seconds_ratio, "Error against time",
                     "seconds a picture, over those of the whole model")
              .build(asked)};
}

}  // namespace quartet
