#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ui/paper/chart_figure.h"
#include "ui/paper/figure_layout.h"

namespace quartet {

/// What a legend shows before its text: a piece of the thing itself.
using LegendSample = std::variant<Line, Band, PointMark, Level>;

struct LegendEntry {
  LegendSample sample;  ///< without points
  Rect box;             ///< of the sample
};

/// The label of a line, beside the chart: a piece of the line before the text.
struct EndLabel {
  const Line* line;
  glm::dvec2 from;  ///< the last of the line's points that is seen, on the page
  Rect sample;
};

/// One chart on the page.
struct PlacedChart {
  const Chart* chart;
  Rect area;                 ///< between the axes, where data are painted
  std::vector<Tick> x_grid;  ///< ticks whose lines cross the area
  std::vector<Tick> y_grid;
  std::vector<EndLabel> end_labels;

  double x(double value) const { return area.x + axis_position(chart->x, value) * area.width; }
  double y(double value) const {
    return area.bottom() - axis_position(chart->y, value) * area.height;
  }
};

/// What is where on a page of charts. It refers to the figure, which must outlive it.
struct ChartLayout {
  double width = 0, height = 0;
  double line_size = 0;
  std::vector<PlacedChart> charts;
  std::vector<LegendEntry> legend;
  std::vector<PlacedText> texts;  ///< all text but that inside a chart
};

ChartLayout lay_out(const ChartFigure& figure);
ChartLayout lay_out(const ChartFigure&& gone) = delete;

/// Labels, and what stands before them.
using LegendEntries = std::vector<std::pair<std::string, LegendSample>>;

/// The legend's entries of all charts, each label once.
LegendEntries legend_of(const ChartFigure& figure);

}  // namespace quartet
