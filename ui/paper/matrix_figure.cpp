#include "ui/paper/matrix_figure.h"

#include <cairo.h>

#include <algorithm>
#include <cassert>
#include <numbers>

#include "ui/paper/cairo_page.h"
#include "ui/paper/figure_text.h"

namespace quartet {
namespace {

constexpr double page_margin = 24.0;
constexpr double least_cell_width = 72.0;
constexpr double one_line_height = 25.0;  // of a cell
constexpr double small_height = 10.5;     // of each line below it
constexpr double cell_gap = 2.0;          // between cells
constexpr double swatch = 14.0;
constexpr double header_angle = -std::numbers::pi / 5.0;
constexpr TextStyle title_style{20.0, true};
constexpr TextStyle panel_style{15.0, true};
constexpr TextStyle line_style{12.5, false, 0.25};
constexpr TextStyle label_style{13.0};
constexpr TextStyle cell_style{12.5, true};
constexpr TextStyle small_style{8.5, false, 1.0};
constexpr double matrix_line_height = 18.0;

/// What everything on a page depends on.
struct MatrixLayout {
  double width = 0.0;
  double label_width = 0.0;
  double cell_width = least_cell_width;
  double cell_height = one_line_height;
};

/// Paints from the top down and keeps the place; the same code measures the height, without a
/// painter.
class Pen {
 public:
  Pen(cairo_t* cairo, const MatrixLayout& layout) : cairo_(cairo), layout_(layout) {}

  double y() const { return y_; }
  void skip(double height) { y_ += height; }

  void line(const std::string& text, const TextStyle& style, double height, double indent = 0.0) {
    show(text, style, page_margin + indent, y_ + 0.75 * height);
    y_ += height;
  }

  void wrapped(const std::string& text, const TextStyle& style, double indent = 0.0) {
    for (const std::string& part :
         measure_.wrap(clean_text(text), style, layout_.width - 2.0 * page_margin - indent, 6)) {
      line(part, style, matrix_line_height, indent);
    }
  }

  void headers(const std::vector<std::string>& columns) {
    double longest = 0.0;
    for (const std::string& column : columns) {
      longest = std::max(longest, measure_.width(column, label_style));
    }
    y_ += longest * -std::sin(header_angle) + 16.0;
    for (std::size_t i = 0; i < columns.size() && cairo_; ++i) {
      cairo_save(cairo_);
      cairo_translate(cairo_, left(i) + 0.5 * layout_.cell_width - 4.0, y_ - 6.0);
      cairo_rotate(cairo_, header_angle);
      show(columns[i], label_style, 0.0, 0.0);
      cairo_restore(cairo_);
    }
  }

  void row(const std::string& label, const MatrixFigure::Cell* cells, std::size_t count) {
    show(label, label_style,
         page_margin + layout_.label_width - 10.0 - measure_.width(label, label_style),
         y_ + 0.5 * layout_.cell_height + 4.5);
    for (std::size_t i = 0; i < count; ++i) {
      fill(cells[i].color, left(i), y_, layout_.cell_width - cell_gap,
           layout_.cell_height - cell_gap);
      double baseline = y_ + 0.5 * one_line_height + 4.0;
      centred(cells[i].text, {cell_style.size, cell_style.bold, 1.0}, i, baseline);
      for (const std::string& line : cells[i].small) {
        baseline += small_height;
        centred(line, small_style, i, baseline);
      }
    }
    y_ += layout_.cell_height;
  }

  void entry(const MatrixFigure::Entry& entry) {
    fill(entry.color, page_margin, y_ + 2.0, swatch, swatch);
    const double indent = swatch + 8.0;
    const double width = measure_.width(entry.label + "  ", cell_style);
    show(entry.label, cell_style, page_margin + indent, y_ + 0.75 * matrix_line_height);
    wrapped(entry.rule, line_style, indent + width);
  }

 private:
  double left(std::size_t column) const {
    return page_margin + layout_.label_width + layout_.cell_width * double(column);
  }

  void show(const std::string& text, const TextStyle& style, double x, double baseline) {
    if (cairo_) {
      select_font(cairo_, style);
      cairo_set_source_rgb(cairo_, style.gray, style.gray, style.gray);
      cairo_move_to(cairo_, x, baseline);
      cairo_show_text(cairo_, clean_text(text).c_str());
    }
  }

  void centred(const std::string& text, const TextStyle& style, std::size_t column,
               double baseline) {
    show(text, style,
         left(column) + 0.5 * (layout_.cell_width - cell_gap - measure_.width(text, style)),
         baseline);
  }

  void fill(const Rgba8& color, double x, double y, double width, double height) {
    if (cairo_) {
      cairo_set_source_rgb(cairo_, color.r / 255.0, color.g / 255.0, color.b / 255.0);
      cairo_rectangle(cairo_, x, y, width, height);
      cairo_fill(cairo_);
    }
  }

  cairo_t* cairo_;  // null: only measures
  const MatrixLayout& layout_;
  double y_ = page_margin;
  TextMeasure measure_;
};

/// Paints the figure, or measures it if `cairo` is null; returns its height.
double paint(const MatrixFigure& figure, cairo_t* cairo, const MatrixLayout& layout) {
  Pen pen(cairo, layout);
  pen.line(figure.title, title_style, 28.0);
  for (const std::string& line : figure.lines) {
    pen.wrapped(line, line_style);
  }
  for (const MatrixFigure::Panel& panel : figure.panels) {
    assert(panel.cells.size() == figure.rows.size() * figure.columns.size());
    pen.skip(14.0);
    pen.line(panel.title, panel_style, 20.0);
    pen.headers(figure.columns);
    for (std::size_t row = 0; row < figure.rows.size(); ++row) {
      pen.row(figure.rows[row], panel.cells.data() + row * figure.columns.size(),
              figure.columns.size());
    }
  }
  pen.skip(16.0);
  for (const MatrixFigure::Entry& entry : figure.legend) {
    pen.entry(entry);
    pen.skip(2.0);
  }
  pen.skip(8.0);
  pen.wrapped(figure.footer, {11.0, false, 0.45});
  return pen.y() + page_margin;
}

MatrixLayout layout_of(const MatrixFigure& figure) {
  const TextMeasure measure;
  MatrixLayout layout;
  for (const std::string& row : figure.rows) {
    layout.label_width = std::max(layout.label_width, measure.width(row, label_style) + 14.0);
  }
  std::size_t small_lines = 0;
  for (const MatrixFigure::Panel& panel : figure.panels) {
    for (const MatrixFigure::Cell& cell : panel.cells) {
      small_lines = std::max(small_lines, cell.small.size());
      for (const std::string& line : cell.small) {
        layout.cell_width =
            std::max(layout.cell_width, measure.width(line, small_style) + 8.0 + cell_gap);
      }
    }
  }
  layout.cell_height += small_height * double(small_lines);
  // The last header leans over the right end of its column.
  const double overhang =
      figure.columns.empty() ? 0.0 : measure.width(figure.columns.back(), label_style) * 0.85;
  const double columns = layout.cell_width * double(figure.columns.size());
  layout.width = std::ceil(std::max(720.0, 2.0 * page_margin + layout.label_width + columns +
                                               std::max(0.0, overhang - 0.5 * layout.cell_width)));
  return layout;
}

CairoPage page_of(const MatrixFigure& figure) {
  const MatrixLayout layout = layout_of(figure);
  CairoPage page;
  page.width = layout.width;
  page.height = std::ceil(paint(figure, nullptr, layout));
  page.line_size = line_style.size;
  page.title = figure.title;
  page.paint = [&figure, layout](cairo_t* cairo) { paint(figure, cairo, layout); };
  return page;
}

}  // namespace

void write_matrix_png(const MatrixFigure& figure, const std::filesystem::path& path) {
  write_page_png(page_of(figure), path);
}

void write_matrix_pdf(const MatrixFigure& figure, const std::filesystem::path& path) {
  write_page_pdf(page_of(figure), path);
}

}  // namespace quartet
