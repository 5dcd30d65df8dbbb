#include "ui/paper/chart_layout.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "ui/paper/figure_text.h"
#include "ui/paper/label_places.h"

namespace quartet {
namespace {

constexpr double line_size = 17.0;  // size of the text, in pixels of the PNG
constexpr double chart_line_height = 1.35;
constexpr double chart_gray = 0.35;
constexpr double sample_width = 2.4 * line_size;
constexpr double leader_width = 1.2 * line_size;  // from a chart to the labels of its lines

bool is_seen(const Chart& chart, const glm::dvec2& point) {
  const double x = axis_position(chart.x, point.x);
  const double y = axis_position(chart.y, point.y);
  return x >= 0.0 && x <= 1.0 && y >= 0.0 && y <= 1.0;
}

/// Puts charts and texts into a layout, from the top down.
class ChartBuilder {
 public:
  explicit ChartBuilder(const ChartFigure& figure) : figure_(figure) {
    const int count = std::max(1, int(figure.charts.size()));
    columns_ = std::clamp(figure.columns, 1, count);
    for (const Chart& chart : figure.charts) {
      for (const Tick& tick : chart.y.ticks) {
        tick_width_ = std::max(tick_width_, measure_.width(tick.label, tick_style()));
      }
      for (const Line& line : chart.lines) {
        if (line.label_at_end) {
          label_width_ =
              std::max(label_width_, measure_.width(clean_text(line.label), tick_style()));
        }
      }
    }
    if (label_width_ > 0.0) {
      label_width_ = std::min(std::ceil(label_width_), 20.0 * line_size);
      label_room_ = leader_width + end_sample + 0.4 * line_size + label_width_;
    }
    tick_width_ = std::ceil(tick_width_ + 0.6 * line_size);
    cell_width_ = tick_width_ + figure.area_width + label_room_ + line_size;
    page_width_ = columns_ * cell_width_ + (columns_ - 1) * gap;
  }

  ChartLayout build() {
    y_ = margin;
    add_text(figure_.title, {1.4 * line_size, true}, margin, page_width_, 3);
    for (const std::string& line : figure_.lines) {
      add_text(line, line_style(), margin, page_width_, 4);
    }
    for (std::size_t first = 0; first < figure_.charts.size(); first += std::size_t(columns_)) {
      y_ += 1.2 * line_size;
      add_row(first);
    }
    add_legend();
    if (!figure_.footer.empty()) {
      y_ += 0.8 * line_size;
      add_text(figure_.footer, {0.85 * line_size, false, 0.45}, margin, page_width_, 6);
    }
    layout_.width = page_width_ + 2 * margin;
    layout_.height = std::ceil(y_ + margin);
    layout_.line_size = line_size;
    return std::move(layout_);
  }

 private:
  static constexpr double margin = 1.6 * line_size;
  static constexpr double gap = 1.6 * line_size;
  static constexpr double legend_line = 1.5 * line_size;
  static constexpr double end_sample = 1.9 * line_size;

  static TextStyle line_style() { return {line_size, false, chart_gray}; }
  static TextStyle tick_style() { return {0.9 * line_size, false, chart_gray}; }

  void put(const std::string& text, const TextStyle& style, double x, double y) {
    layout_.texts.push_back({text,
                             {x, y, measure_.width(text, style), chart_line_height * style.size},
                             y + style.size,
                             style});
  }

  void add_text(const std::string& text, const TextStyle& style, double x, double width,
                int max_lines) {
    for (const std::string& line : measure_.wrap(text, style, width, max_lines)) {
      put(line, style, x, y_);
      y_ += chart_line_height * style.size;
    }
  }

  void add_row(std::size_t first) {
    const double top = y_;
    double below = top;
    const std::size_t end = std::min(first + std::size_t(columns_), figure_.charts.size());
    for (std::size_t i = first; i < end; ++i) {
      y_ = top;
      const double x = margin + double(i - first) * (cell_width_ + gap);
      const Chart& chart = figure_.charts[i];
      add_text(chart.title, {1.1 * line_size, true}, x, cell_width_, 2);
      // Above its axis, where it need not be turned to be read.
      add_text(chart.y.label, line_style(), x, cell_width_, 2);
      below = std::max(below, y_);
    }
    const double area_top = std::ceil(below + 0.5 * line_size);
    for (std::size_t i = first; i < end; ++i) {
      const double x = margin + double(i - first) * (cell_width_ + gap);
      add_chart(figure_.charts[i],
                {std::round(x + tick_width_), area_top, figure_.area_width, figure_.area_height});
    }
    last_area_top_ = area_top;
    y_ = area_top + figure_.area_height + 0.8 * line_size + 2 * chart_line_height * line_size;
  }

  void add_chart(const Chart& chart, const Rect& area) {
    PlacedChart placed{&chart, area, {}, {}, {}};
    double taken = area.x - tick_width_;
    const double tick_top = area.bottom() + 0.7 * line_size;
    for (const Tick& tick : chart.x.ticks) {
      placed.x_grid.push_back(tick);
      const double width = measure_.width(tick.label, tick_style());
      const double left = placed.x(tick.value) - width / 2;
      // A number that would touch the one before is left out; its line stays.
      if (left >= taken && left + width <= area.right() + line_size) {
        put(tick.label, tick_style(), left, tick_top);
        taken = left + width + 0.5 * line_size;
      }
    }
    double above = area.bottom() + line_size;
    for (const Tick& tick : chart.y.ticks) {
      placed.y_grid.push_back(tick);
      const double width = measure_.width(tick.label, tick_style());
      const double top = placed.y(tick.value) - 0.5 * chart_line_height * tick_style().size;
      if (top + chart_line_height * tick_style().size <= above) {
        put(tick.label, tick_style(), area.x - width - 0.4 * line_size, top);
        above = top;
      }
    }
    const auto label = measure_.wrap(chart.x.label, line_style(), area.width, 1);
    if (!label.empty()) {
      const double width = measure_.width(label[0], line_style());
      put(label[0], line_style(), area.x + (area.width - width) / 2,
          tick_top + chart_line_height * line_size);
    }
    add_end_labels(placed);
    layout_.charts.push_back(std::move(placed));
  }

  /// To the right of the chart, in the order of the lines' ends from the top down.
  void add_end_labels(PlacedChart& placed) {
    for (const Line& line : placed.chart->lines) {
      if (!line.label_at_end || line.label.empty() || line.points.empty()) {
        continue;
      }
      // Of a line that is not seen at all, the place on the rim that is nearest to its end.
      const auto seen =
          std::find_if(line.points.rbegin(), line.points.rend(),
                       [&](const glm::dvec2& point) { return is_seen(*placed.chart, point); });
      const glm::dvec2 last = seen != line.points.rend() ? *seen : line.points.back();
      const Rect& area = placed.area;
      placed.end_labels.push_back({&line,
                                   {std::clamp(placed.x(last.x), area.x, area.right()),
                                    std::clamp(placed.y(last.y), area.y, area.bottom())},
                                   {}});
    }
    std::ranges::stable_sort(placed.end_labels, {}, [](const EndLabel& l) { return l.from.y; });
    const double height = chart_line_height * tick_style().size;
    std::vector<double> wanted;
    for (const EndLabel& label : placed.end_labels) {
      wanted.push_back(label.from.y - 0.5 * height);
    }
    const std::vector<double> tops =
        label_places(wanted, height, placed.area.y, placed.area.bottom());
    const double left = placed.area.right() + leader_width;
    for (std::size_t i = 0; i < tops.size(); ++i) {
      EndLabel& label = placed.end_labels[i];
      label.sample = {left, tops[i], end_sample, height};
      const auto text = measure_.wrap(label.line->label, tick_style(), label_width_ + 1.0, 1);
      put(text.at(0), tick_style(), left + end_sample + 0.4 * line_size, tops[i]);
    }
  }

  /// Where the last row of charts leaves room for it, else below. In columns as wide as the widest
  /// entry, in rows from the top left.
  void add_legend() {
    const auto entries = legend_of(figure_);
    if (entries.empty()) {
      return;
    }
    double widest = 0.0;
    for (const auto& [label, sample] : entries) {
      widest = std::max(widest, measure_.width(clean_text(label), line_style()));
    }
    const double lead = sample_width + 0.6 * line_size;
    const double column = lead + widest + 1.6 * line_size;
    const int taken = int(figure_.charts.size()) % columns_;
    const double left = margin + taken * (cell_width_ + gap);
    const Rect beside{left, last_area_top_, margin + page_width_ - left, figure_.area_height};
    if (taken > 0 && column <= beside.width &&
        legend_height(int(entries.size()), column, beside.width) <= beside.height) {
      put_legend(entries, beside, column);
      return;
    }
    y_ += 0.8 * line_size;
    const Rect below{margin, y_, page_width_, 0.0};
    put_legend(entries, below, column);
    y_ += legend_height(int(entries.size()), column, below.width);
  }

  static int legend_columns(double column, double width) {
    return std::max(1, int(width / column));
  }
  static double legend_height(int entries, double column, double width) {
    const int columns = legend_columns(column, width);
    const int rows = (entries + columns - 1) / columns;
    return rows * legend_line;
  }

  void put_legend(const LegendEntries& entries, const Rect& box, double column) {
    const int columns = legend_columns(column, box.width);
    const double lead = sample_width + 0.6 * line_size;
    const double room = std::min(column, box.width) - lead;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const int row = int(i) / columns;
      const double x = box.x + double(int(i) % columns) * column;
      const double y = box.y + double(row) * legend_line;
      layout_.legend.push_back(
          {entries[i].second, {x, y, sample_width, chart_line_height * line_size}});
      const auto text = measure_.wrap(entries[i].first, line_style(), room, 1);
      put(text.at(0), line_style(), x + lead, y);
    }
  }

  const ChartFigure& figure_;
  TextMeasure measure_;
  ChartLayout layout_;
  int columns_ = 1;
  double tick_width_ = 0;
  double label_width_ = 0;  // of the widest label at the end of a line
  double label_room_ = 0;   // beside each chart
  double cell_width_ = 0;
  double page_width_ = 0;
  double last_area_top_ = 0;
  double y_ = 0;  // where the next thing goes
};

}  // namespace

LegendEntries legend_of(const ChartFigure& figure) {
  LegendEntries entries;
  const auto add = [&](const auto& thing) {
    if constexpr (std::is_same_v<std::decay_t<decltype(thing)>, Line>) {
      if (thing.label_at_end) {
        return;
      }
    }
    const auto known = [&](const auto& entry) { return entry.first == thing.label; };
    if (!thing.label.empty() && std::ranges::none_of(entries, known)) {
      entries.emplace_back(thing.label, thing);
    }
  };
  // By kind, so that lines stand together whatever chart they are in.
  for (const Chart& chart : figure.charts) {
    std::ranges::for_each(chart.lines, add);
  }
  for (const Chart& chart : figure.charts) {
    std::ranges::for_each(chart.marks, add);
    std::ranges::for_each(chart.bands, add);
    std::ranges::for_each(chart.levels, add);
  }
  return entries;
}

ChartLayout lay_out(const ChartFigure& figure) {
  return ChartBuilder(figure).build();
}

}  // namespace quartet
