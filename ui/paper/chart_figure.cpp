#include "ui/paper/chart_figure.h"

#include <cairo.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <span>

#include "ui/paper/cairo_page.h"
#include "ui/paper/chart_layout.h"
#include "ui/paper/figure_text.h"

namespace quartet {
namespace {

constexpr double line_width = 2.2;
constexpr double dot_size = 4.5;
constexpr double mark_radius = 7.0;

void set_color(cairo_t* cairo, Rgba8 color) {
  cairo_set_source_rgba(cairo, color.r / 255.0, color.g / 255.0, color.b / 255.0, color.a / 255.0);
}

void set_dashes(cairo_t* cairo, Dash dash) {
  static constexpr std::array dashed{8.0, 5.0};
  static constexpr std::array dash_dot{10.0, 4.0, 2.0, 4.0};
  static constexpr std::array dotted{2.0, 4.0};
  std::span<const double> pattern;
  switch (dash) {
    case Dash::solid:
      break;
    case Dash::dashed:
      pattern = dashed;
      break;
    case Dash::dash_dot:
      pattern = dash_dot;
      break;
    case Dash::dotted:
      pattern = dotted;
      break;
  }
  cairo_set_dash(cairo, pattern.data(), int(pattern.size()), 0.0);
}

/// Whether it is made of strokes, and has nothing to fill.
bool is_open(MarkShape shape) {
  return shape == MarkShape::cross;
}

/// Of about the same area whatever the shape.
void trace_shape(cairo_t* cairo, glm::dvec2 at, MarkShape shape, double r) {
  cairo_new_path(cairo);
  const auto polygon = [&](std::initializer_list<glm::dvec2> corners) {
    for (const glm::dvec2& corner : corners) {
      cairo_line_to(cairo, at.x + r * corner.x, at.y + r * corner.y);
    }
    cairo_close_path(cairo);
  };
  switch (shape) {
    case MarkShape::dot:
      cairo_arc(cairo, at.x, at.y, 0.8 * r, 0.0, 2.0 * M_PI);
      break;
    case MarkShape::square:
      polygon({{-0.72, -0.72}, {0.72, -0.72}, {0.72, 0.72}, {-0.72, 0.72}});
      break;
    case MarkShape::triangle:
      polygon({{0.0, -1.0}, {0.95, 0.7}, {-0.95, 0.7}});
      break;
    case MarkShape::wedge:
      polygon({{0.0, 1.0}, {0.95, -0.7}, {-0.95, -0.7}});
      break;
    case MarkShape::diamond:
      polygon({{0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}});
      break;
    case MarkShape::cross:
      cairo_move_to(cairo, at.x - 0.7 * r, at.y - 0.7 * r);
      cairo_line_to(cairo, at.x + 0.7 * r, at.y + 0.7 * r);
      cairo_move_to(cairo, at.x - 0.7 * r, at.y + 0.7 * r);
      cairo_line_to(cairo, at.x + 0.7 * r, at.y - 0.7 * r);
      break;
  }
}

/// In the colour that is set.
void paint_shape(cairo_t* cairo, glm::dvec2 at, MarkShape shape, double r) {
  trace_shape(cairo, at, shape, r);
  if (is_open(shape)) {
    cairo_set_line_width(cairo, 1.6);
    cairo_stroke(cairo);
  } else {
    cairo_fill(cairo);
  }
}

void stroke(cairo_t* cairo, std::span<const glm::dvec2> points, const Line& line) {
  set_color(cairo, line.color);
  cairo_set_line_width(cairo, line_width * double(line.width));
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  set_dashes(cairo, line.dash);
  cairo_new_path(cairo);  // text leaves a point behind
  for (const glm::dvec2& point : points) {
    cairo_line_to(cairo, point.x, point.y);
  }
  cairo_stroke(cairo);
  set_dashes(cairo, Dash::solid);
  if (line.dots) {
    for (const glm::dvec2& point : points) {
      paint_shape(cairo, point, line.shape, dot_size);
    }
  }
}

void stroke_level(cairo_t* cairo, double left, double right, double y, Rgba8 color) {
  constexpr std::array dots{3.0, 4.0};
  set_color(cairo, color);
  cairo_set_line_width(cairo, 2.0);
  cairo_set_dash(cairo, dots.data(), int(dots.size()), 0.0);
  // On whole pixels, so that a thin line is as dark as it says.
  cairo_move_to(cairo, left, std::round(y));
  cairo_line_to(cairo, right, std::round(y));
  cairo_stroke(cairo);
  set_dashes(cairo, Dash::solid);
}

/// With a rim of paper, so that it is seen on a line of its own colour.
void fill_mark(cairo_t* cairo, glm::dvec2 at, const PointMark& mark) {
  trace_shape(cairo, at, mark.shape, mark_radius);
  const bool open = is_open(mark.shape);
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_set_line_width(cairo, open ? 5.0 : 3.0);
  cairo_stroke_preserve(cairo);
  set_color(cairo, mark.color);
  cairo_set_line_width(cairo, 2.2);
  if (open) {
    cairo_stroke(cairo);
  } else {
    cairo_fill(cairo);
  }
}

void paint_grid(cairo_t* cairo, const PlacedChart& placed) {
  const Rect& area = placed.area;
  cairo_set_source_rgb(cairo, 0.9, 0.9, 0.9);
  cairo_set_line_width(cairo, 1.0);
  for (const Tick& tick : placed.x_grid) {
    const double x = std::round(placed.x(tick.value)) + 0.5;
    cairo_move_to(cairo, x, area.y);
    cairo_line_to(cairo, x, area.bottom() + 4.0);
  }
  for (const Tick& tick : placed.y_grid) {
    const double y = std::round(placed.y(tick.value)) + 0.5;
    cairo_move_to(cairo, area.x - 4.0, y);
    cairo_line_to(cairo, area.right(), y);
  }
  cairo_stroke(cairo);
  cairo_set_source_rgb(cairo, 0.55, 0.55, 0.55);
  cairo_move_to(cairo, area.x + 0.5, area.y);
  cairo_line_to(cairo, area.x + 0.5, area.bottom() + 0.5);
  cairo_line_to(cairo, area.right(), area.bottom() + 0.5);
  cairo_stroke(cairo);
}

void paint_below_lines(cairo_t* cairo, const PlacedChart& placed) {
  const Chart& chart = *placed.chart;
  const Rect& area = placed.area;
  for (const Shade& shade : chart.shades) {
    set_color(cairo, shade.color);
    const double left = placed.x(shade.begin);
    cairo_rectangle(cairo, left, area.y, placed.x(shade.end) - left, area.height);
    cairo_fill(cairo);
  }
  for (const Bar& bar : chart.bars) {
    set_color(cairo, bar.color);
    const double left = placed.x(bar.begin);
    const double top = placed.y(bar.value);
    cairo_rectangle(cairo, left, top, placed.x(bar.end) - left, area.bottom() - top);
    cairo_fill(cairo);
  }
  for (const Band& band : chart.bands) {
    set_color(cairo, band.color);
    cairo_new_path(cairo);
    // One path, filled where it winds at all: pieces that overlap do not darken each other.
    for (std::size_t i = 0; i + 1 < band.lower.size(); ++i) {
      cairo_new_sub_path(cairo);
      for (const glm::dvec2& p :
           {band.lower[i], band.lower[i + 1], band.upper[i + 1], band.upper[i]}) {
        cairo_line_to(cairo, placed.x(p.x), placed.y(p.y));
      }
      cairo_close_path(cairo);
    }
    cairo_fill(cairo);
  }
}

void paint_data(cairo_t* cairo, const PlacedChart& placed) {
  const Chart& chart = *placed.chart;
  const Rect& area = placed.area;
  cairo_save(cairo);
  cairo_rectangle(cairo, area.x, area.y, area.width, area.height);
  cairo_clip(cairo);
  paint_below_lines(cairo, placed);
  for (const Level& level : chart.levels) {
    stroke_level(cairo, area.x, area.right(), placed.y(level.value), level.color);
  }
  std::vector<glm::dvec2> points;
  for (const Line& line : chart.lines) {
    points.clear();
    for (const glm::dvec2& point : line.points) {
      points.emplace_back(placed.x(point.x), placed.y(point.y));
    }
    stroke(cairo, points, line);
  }
  for (const PointMark& mark : chart.marks) {
    fill_mark(cairo, {placed.x(mark.at.x), placed.y(mark.at.y)}, mark);
  }
  for (const Marker& marker : chart.markers) {
    const double x = placed.x(marker.value);
    set_color(cairo, marker.color);
    cairo_set_line_width(cairo, line_width);
    cairo_move_to(cairo, x, area.y);
    cairo_line_to(cairo, x, area.bottom());
    cairo_stroke(cairo);
  }
  cairo_restore(cairo);
}

void paint_inner_texts(cairo_t* cairo, const PlacedChart& placed, double size) {
  const TextMeasure measure;
  const TextStyle style{0.9 * size, false, 0.25};
  for (const ChartText& text : placed.chart->texts) {
    const std::string words = clean_text(text.text);
    const double width = measure.width(words, style);
    const double share = text.align == Align::left ? 0.0 : text.align == Align::center ? 0.5 : 1.0;
    const double x = placed.area.x + text.place.x * placed.area.width - share * width;
    const double y = placed.area.bottom() - text.place.y * placed.area.height;
    paint_text(cairo, {words, {x, y, width, 1.35 * style.size}, y + style.size, style});
  }
}

/// A piece of a line, with its mark in the middle.
void paint_line_sample(cairo_t* cairo, const Line& line, const std::array<glm::dvec2, 2>& ends) {
  Line plain = line;
  plain.dots = false;
  stroke(cairo, ends, plain);
  if (line.dots) {
    paint_shape(cairo, 0.5 * (ends[0] + ends[1]), line.shape, dot_size);
  }
}

/// Labels beside a chart, each joined to its line by a hairline of the line's colour.
void paint_end_labels(cairo_t* cairo, const PlacedChart& placed) {
  for (const EndLabel& label : placed.end_labels) {
    const double middle = label.sample.y + label.sample.height / 2;
    Rgba8 pale = label.line->color;
    pale.a = 110;
    set_color(cairo, pale);
    cairo_set_line_width(cairo, 0.9);
    cairo_move_to(cairo, label.from.x, label.from.y);
    cairo_line_to(cairo, placed.area.right(), std::lerp(label.from.y, middle, 0.5));
    cairo_line_to(cairo, label.sample.x, middle);
    cairo_stroke(cairo);
    paint_line_sample(cairo, *label.line,
                      {glm::dvec2(label.sample.x, middle), {label.sample.right(), middle}});
  }
}

void paint_sample(cairo_t* cairo, const LegendEntry& entry) {
  const Rect& box = entry.box;
  const double middle = box.y + box.height / 2;
  const std::array ends{glm::dvec2(box.x, middle), glm::dvec2(box.right(), middle)};
  if (const auto* line = std::get_if<Line>(&entry.sample)) {
    paint_line_sample(cairo, *line, ends);
  } else if (const auto* band = std::get_if<Band>(&entry.sample)) {
    set_color(cairo, band->color);
    cairo_rectangle(cairo, box.x, box.y + 0.2 * box.height, box.width, 0.6 * box.height);
    cairo_fill(cairo);
  } else if (const auto* mark = std::get_if<PointMark>(&entry.sample)) {
    fill_mark(cairo, {box.x + box.width / 2, middle}, *mark);
  } else if (const auto* level = std::get_if<Level>(&entry.sample)) {
    stroke_level(cairo, box.x, box.right(), middle, level->color);
  }
}

void paint(cairo_t* cairo, const ChartLayout& layout) {
  for (const PlacedChart& chart : layout.charts) {
    paint_grid(cairo, chart);
    paint_data(cairo, chart);
    paint_end_labels(cairo, chart);
    paint_inner_texts(cairo, chart, layout.line_size);
  }
  for (const LegendEntry& entry : layout.legend) {
    paint_sample(cairo, entry);
  }
  for (const PlacedText& text : layout.texts) {
    paint_text(cairo, text);
  }
}

CairoPage page_of(const ChartFigure& figure) {
  const ChartLayout layout = lay_out(figure);
  return {layout.width, layout.height, layout.line_size, figure.title,
          [layout](cairo_t* cairo) { paint(cairo, layout); }};
}

}  // namespace

void write_chart_png(const ChartFigure& figure, const std::filesystem::path& path) {
  write_page_png(page_of(figure), path);
}

void write_chart_pdf(const ChartFigure& figure, const std::filesystem::path& path) {
  write_page_pdf(page_of(figure), path);
}

void write_chart_svg(const ChartFigure& figure, const std::filesystem::path& path) {
  write_page_svg(page_of(figure), path);
}

void write_chart_files(StagedFiles& files, const std::string& name, const ChartFigure& figure) {
  write_chart_png(figure, files.stage(name + ".png"));
  write_chart_pdf(figure, files.stage(name + ".pdf"));
  write_chart_svg(figure, files.stage(name + ".svg"));
}

}  // namespace quartet
