#include "ui/paper/figure_layout.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ui/paper/figure_text.h"

namespace quartet {

namespace {

constexpr int min_panel_width = 480;  // below, small pictures are enlarged
constexpr int max_enlarged = 1920;    // but no side beyond this
constexpr double line_height = 1.35;  // of the em
constexpr double figure_gray = 0.35;

/// The whole factor by which all panels of a figure are enlarged.
int enlargement(const Figure& figure) {
  int width = 1;
  int height = 1;
  for (const FigurePanel& panel : figure.panels) {
    assert(!panel.image.empty());
    width = std::max(width, panel.image.width());
    height = std::max(height, panel.image.height());
  }
  const int wanted = (min_panel_width + width - 1) / width;
  return std::clamp(wanted, 1, std::max(1, max_enlarged / std::max(width, height)));
}

/// Puts blocks of text, pictures and bars into a layout, from the top down.
class FigureBuilder {
 public:
  explicit FigureBuilder(const Figure& figure) : figure_(figure), factor_(enlargement(figure)) {
    for (const FigurePanel& panel : figure.panels) {
      cell_width_ = std::max(cell_width_, panel.image.width() * factor_);
    }
    const int count = std::max(1, int(figure.panels.size()));
    columns_ = std::clamp(figure.columns, 1, count);
    rows_ = (int(figure.panels.size()) + columns_ - 1) / columns_;
    choose_line_size();
    margin_ = std::round(1.6 * line_);
    gap_ = std::round(1.2 * line_);
    grid_width_ = columns_ * cell_width_ + (columns_ - 1) * gap_;
  }

  FigureLayout build() {
    y_ = margin_;
    if (add_text(layout_.texts, figure_.title, {1.5 * line_, true}, margin_, grid_width_, 3)) {
      y_ += 0.8 * line_;
    }
    for (int row = 0; row < rows_; ++row) {
      if (row > 0) {
        y_ += 1.8 * line_;
      }
      add_row(row);
    }
    if (figure_.shared_bar) {
      y_ += 1.4 * line_;
      add_bar(*figure_.shared_bar, margin_, grid_width_);
    }
    if (!figure_.footer.empty()) {
      y_ += 1.2 * line_;
      add_text(layout_.texts, figure_.footer, {0.85 * line_, false, 0.45}, margin_, grid_width_, 4);
    }
    layout_.width = grid_width_ + 2 * margin_;
    layout_.height = std::ceil(y_ + margin_);
    layout_.line_size = line_;
    return std::move(layout_);
  }

 private:
  TextStyle title_style() const { return {1.2 * line_, true}; }
  TextStyle line_style() const { return {line_, false, figure_gray}; }

  bool panel_texts_fit() const {
    return std::ranges::all_of(figure_.panels, [&](const FigurePanel& panel) {
      return measure_.width(clean_text(panel.title), title_style()) <= cell_width_ &&
             std::ranges::all_of(panel.lines, [&](const std::string& line) {
               return measure_.width(clean_text(line), line_style()) <= cell_width_;
             });
    });
  }

  /// In proportion to the panels, so that a figure printed at a given width reads the same at any
  /// resolution; somewhat smaller for all panels alike if their texts then fit without a break.
  void choose_line_size() {
    const double normal = 0.03 * cell_width_;
    for (const double scale : {1.0, 0.92, 0.85, 0.78}) {
      line_ = scale * normal;
      if (panel_texts_fit()) {
        return;
      }
    }
    line_ = 0.85 * normal;
  }

  bool add_text(std::vector<PlacedText>& texts, const std::string& text, const TextStyle& style,
                double x, double width, int max_lines) {
    const std::vector<std::string> lines = measure_.wrap(text, style, width, max_lines);
    for (const std::string& line : lines) {
      add_line(texts, line, style, x);
      y_ += line_height * style.size;
    }
    return !lines.empty();
  }

  void add_line(std::vector<PlacedText>& texts, const std::string& line, const TextStyle& style,
                double x) {
    texts.push_back({line,
                     {x, y_, measure_.width(line, style), line_height * style.size},
                     y_ + style.size,
                     style});
  }

  void add_row(int row) {
    const double top = y_;
    double below = top;
    int image_height = 0;
    const auto for_each_panel = [&](auto place) {
      for (int column = 0; column < columns_; ++column) {
        const auto i = std::size_t(row) * std::size_t(columns_) + std::size_t(column);
        if (i < figure_.panels.size()) {
          y_ = top;
          place(figure_.panels[i], margin_ + column * (cell_width_ + gap_));
          below = std::max(below, y_);
        }
      }
    };
    for_each_panel([&](const FigurePanel& panel, double x) {
      image_height = std::max(image_height, panel.image.height() * factor_);
      add_text(layout_.titles, panel.title, title_style(), x, cell_width_, 3);
      for (const std::string& line : panel.lines) {
        add_text(layout_.texts, line, line_style(), x, cell_width_, 3);
      }
    });
    // Pictures of a row begin at one height, on a whole pixel.
    const double image_top = std::ceil(below + (below > top ? 0.4 * line_ : 0.0));
    for_each_panel([&](const FigurePanel& panel, double x) {
      const double width = panel.image.width() * factor_;
      const double height = panel.image.height() * factor_;
      layout_.images.push_back(
          {&panel.image, {x + std::floor((cell_width_ - width) / 2), image_top, width, height}});
      y_ = image_top + image_height;
      if (panel.bar) {
        y_ += 0.7 * line_;
        add_bar(*panel.bar, x, cell_width_);
      }
    });
    y_ = below;
  }

  /// A line with the label and what the cap's colour means, the bar, and its ticks.
  void add_bar(const ColorBar& bar, double x, double width) {
    const TextStyle label_style{line_, false, figure_gray};
    const double top = y_;
    if (!bar.cap_label.empty()) {
      const double swatch = 0.75 * line_;
      const double room = width / 2 - 1.4 * swatch;
      const auto lines = measure_.wrap(bar.cap_label, label_style, room, 1);
      const double text_x = x + width - measure_.width(lines.at(0), label_style);
      add_line(layout_.texts, lines.at(0), label_style, text_x);
      layout_.fills.push_back(
          {cap_color, {text_x - 1.4 * swatch, top + 0.28 * line_, swatch, swatch}});
    }
    const double label_width = bar.cap_label.empty() ? width : width / 2 - line_;
    add_text(layout_.texts, bar.label, label_style, x, label_width, 1);
    y_ = bar.label.empty() && bar.cap_label.empty() ? top : top + 1.5 * line_;

    const Rect box{x, std::round(y_), width, std::round(0.8 * line_)};
    layout_.bars.push_back({bar.scale.color_map, box});
    y_ = box.bottom();
    add_ticks(bar.scale, box);
    y_ += (0.45 + line_height) * line_;
  }

  void add_ticks(const ColorScale& scale, const Rect& bar) {
    const TextStyle style{0.9 * line_, false, figure_gray};
    const double mark_width = std::max(1.0, std::round(line_ / 14));
    const double mark_height = 0.3 * line_;
    std::vector<Tick> ticks = scale_ticks(scale, int(bar.width / (7 * line_)));
    // The ends first: round numbers between them are left out where they would run together.
    if (ticks.size() > 1) {
      std::rotate(ticks.begin() + 1, ticks.end() - 1, ticks.end());
    }
    std::vector<Rect> taken;
    for (const Tick& tick : ticks) {
      const double width = measure_.width(tick.label, style);
      const double at = bar.x + bar.width * scale_position(scale, tick.value);
      const double x = std::clamp(at - width / 2, bar.x, std::max(bar.x, bar.right() - width));
      const bool overlaps = std::ranges::any_of(taken, [&](const Rect& other) {
        return x < other.right() + 0.6 * line_ && other.x < x + width + 0.6 * line_;
      });
      if (overlaps) {
        continue;
      }
      taken.push_back({x, 0, width, 0});
      const double mark_x = std::clamp(at - mark_width / 2, bar.x, bar.right() - mark_width);
      layout_.fills.push_back(
          {{110, 110, 110, 255}, {mark_x, bar.bottom(), mark_width, mark_height}});
      layout_.texts.push_back({tick.label,
                               {x, bar.bottom() + 0.4 * line_, width, line_height * style.size},
                               bar.bottom() + 0.4 * line_ + style.size,
                               style});
    }
  }

  const Figure& figure_;
  TextMeasure measure_;
  FigureLayout layout_;
  int factor_;
  int columns_ = 1;
  int rows_ = 0;
  int cell_width_ = min_panel_width;
  double line_ = 0;
  double margin_ = 0;
  double gap_ = 0;
  double grid_width_ = 0;
  double y_ = 0;  // where the next thing goes
};

}  // namespace

FigureLayout lay_out(const Figure& figure) {
  return FigureBuilder(figure).build();
}

}  // namespace quartet
