#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/view/color_map.h"
#include "renderer/view/ticks.h"

namespace quartet {

/// A chart as data: what it says, not how it is drawn, so that window and files paint the same one.
/// Numbers are in the units of the axes unless said otherwise.
struct Axis {
  double min = 0.0;
  double max = 1.0;                   ///< above min
  Spacing spacing = Spacing::linear;  ///< logarithmic: min above 0
  std::string label;                  ///< with the unit
  std::vector<Tick> ticks;            ///< inside [min, max]
};

/// Where a number lies along an axis: 0 at min, 1 at max, beyond them outside; what a logarithmic
/// axis cannot show lies below 0.
double axis_position(const Axis& axis, double value);
/// The number at a position: what a dragged marker is worth.
double axis_value(const Axis& axis, double position);

/// From the bottom of the chart up to `value`, over [begin, end] of the horizontal axis.
struct Bar {
  double begin = 0.0;
  double end = 0.0;
  double value = 0.0;
  Rgba8 color;
};

enum class MarkShape { dot, square, triangle, wedge, diamond, cross };

enum class Dash { solid, dashed, dash_dot, dotted };

/// A curve through points. Between them it is straight on the axes as they are spaced.
struct Line {
  std::string label;  ///< may be empty; else it stands in the legend, or at the line's end
  Rgba8 color;
  std::vector<glm::dvec2> points;
  Dash dash = Dash::solid;
  bool dots = false;                 ///< a mark at each point: what was measured
  float width = 1.0f;                ///< of ordinary lines
  int id = -1;                       ///< whose line it is, such as a lane's number; -1: nobody's
  MarkShape shape = MarkShape::dot;  ///< of its marks
  /// On paper its label stands beside the chart, joined to the last of its points that is seen.
  bool label_at_end = false;
};

/// The area between two curves, such as a line's spread over seeds: that of the quadrilaterals
/// between each pair of points and the next.
struct Band {
  std::string label;  ///< may be empty; else it stands in the legend
  Rgba8 color;        ///< mostly transparent
  std::vector<glm::dvec2> lower;
  std::vector<glm::dvec2> upper;  ///< as many points
};

/// A single point, such as where on a curve the default threshold lies.
struct PointMark {
  std::string label;  ///< may be empty; else it stands in the legend, once for all that share it
  Rgba8 color;
  glm::dvec2 at{0.0};
  MarkShape shape = MarkShape::diamond;
};

/// A horizontal line across the whole chart, such as a noise floor.
struct Level {
  std::string label;  ///< what it is, with its value; may be empty
  Rgba8 color;
  double value = 0.0;
};

/// The background of [begin, end] of the horizontal axis.
struct Shade {
  double begin = 0.0;
  double end = 0.0;
  Rgba8 color;  ///< mostly transparent
};

/// A vertical line that can be dragged.
struct Marker {
  int id = 0;  ///< for a threshold, its channel
  double value = 0.0;
  Rgba8 color;
  std::string label;
};

enum class Align { left, center, right };

/// A text inside the chart.
struct ChartText {
  glm::dvec2 place{0.0};  ///< share of the chart's area, from its bottom left: of the text's top
  Align align = Align::left;
  std::string text;
  Rgba8 color;
};

struct Chart {
  std::string title;
  Axis x;
  Axis y;
  std::vector<Shade> shades;  ///< furthest back; the others follow in this order
  std::vector<Bar> bars;
  std::vector<Band> bands;
  std::vector<Level> levels;
  std::vector<Line> lines;
  std::vector<PointMark> marks;
  std::vector<Marker> markers;
  std::vector<ChartText> texts;
};

/// What the chart shows above x: the bar there, or each line's value. Empty if nothing is there.
std::string reading_at(const Chart& chart, double x);

/// The marker nearest to a horizontal position in [0, 1], if it is within `reach`; else null.
const Marker* marker_near(const Chart& chart, double position, double reach);

/// A linear axis from min to max or, where they are alike, a little more.
Axis linear_axis(double min, double max, std::string label, int wanted_ticks);
/// A logarithmic axis over [10^first, 10^last], with a tick a power of ten.
Axis decade_axis(int first, int last, std::string label);
/// A logarithmic axis that holds [min, max]: from and to 1, 2 or 5 times a power of ten, so that it
/// stands still while data grow, with about so many ticks. [0.1, 1] where there is no positive and
/// finite range.
Axis log_axis(double min, double max, std::string label, int wanted_ticks);

}  // namespace quartet
