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
constexpr double cell_width = 72.0;
constexpr double cell_height = 25.0;
constexpr double cell_gap = 2.0;  // between cells
constexpr double swatch = 14.0;
constexpr double header_angle = -std::numbers::pi / 5.0;
constexpr TextStyle title_style{20.0, true};
constexpr TextStyle panel_style{15.0, true};
constexpr TextStyle line_style{12.5, false, 0.25};
constexpr TextStyle label_style{13.0};
constexpr TextStyle cell_style{12.5, true};
constexpr double matrix_line_height = 18.0;

/// Paints from the top down and keeps the place; the same code measures the height, without a
/// painter.
class Pen {
 public:
  Pen(cairo_t* cairo, double width, double label_width)
      : cairo_(cairo), width_(width), label_width_(label_width) {}

  double y() const { return y_; }
  void skip(double height) { y_ += height; }

  void line(const std::string& text, const TextStyle& style, double height, double indent = 0.0) {
    show(text, style, page_margin + indent, y_ + 0.75 * height);
    y_ += height;
  }

  void wrapped(const std::string& text, const TextStyle& style, double indent = 0.0) {
    for (const std::string& part :
         measure_.wrap(clean_text(text), style, width_ - 2.0 * page_margin - indent, 6)) {
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
      cairo_translate(cairo_, left(i) + 0.5 * cell_width - 4.0, y_ - 6.0);
      cairo_rotate(cairo_, header_angle);
      show(columns[i], label_style, 0.0, 0.0);
      cairo_restore(cairo_);
    }
  }

  void row(const std::string& label, const MatrixFigure::Cell* cells, std::size_t count) {
    const double baseline = y_ + 0.5 * cell_height + 4.5;
    show(label, label_style, page_margin + label_width_ - 10.0 - measure_.width(label, label_style),
         baseline);
    for (std::size_t i = 0; i < count; ++i) {
      fill(cells[i].color, left(i), y_, cell_width - cell_gap, cell_height - cell_gap);
      const double width = measure_.width(cells[i].text, cell_style);
      show(cells[i].text, {cell_style.size, cell_style.bold, 1.0},
           left(i) + 0.5 * (cell_width - cell_gap - width), baseline - 0.5);
    }
    y_ += cell_height;
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
    return page_margin + label_width_ + cell_width * double(column);
  }

  void show(const std::string& text, const TextStyle& style, double x, double baseline) {
    if (cairo_) {
      select_font(cairo_, style);
      cairo_set_source_rgb(cairo_, style.gray, style.gray, style.gray);
      cairo_move_to(cairo_, x, baseline);
      cairo_show_text(cairo_, clean_text(text).c_str());
    }
  }

  void fill(const Rgba8& color, double x, double y, double width, double height) {
    if (cairo_) {
      cairo_set_source_rgb(cairo_, color.r / 255.0, color.g / 255.0, color.b / 255.0);
      cairo_rectangle(cairo_, x, y, width, height);
      cairo_fill(cairo_);
    }
  }

  cairo_t* cairo_;  // null: only measures
  double width_;
  double label_width_;
  double y_ = page_margin;
  TextMeasure measure_;
};

/// Paints the figure, or measures it if `cairo` is null; returns its height.
double paint(const MatrixFigure& figure, cairo_t* cairo, double width, double label_width) {
  Pen pen(cairo, width, label_width);
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

CairoPage page_of(const MatrixFigure& figure) {
  const TextMeasure measure;
  double label_width = 0.0;
  for (const std::string& row : figure.rows) {
    label_width = std::max(label_width, measure.width(row, label_style) + 14.0);
  }
  // The last header leans over the right end of its column.
  const double overhang =
      figure.columns.empty() ? 0.0 : measure.width(figure.columns.back(), label_style) * 0.85;
  const double width =
      std::max(720.0, 2.0 * page_margin + label_width + cell_width * double(figure.columns.size()) +
                          std::max(0.0, overhang - 0.5 * cell_width));
  CairoPage page;
  page.width = std::ceil(width);
  page.height = std::ceil(paint(figure, nullptr, page.width, label_width));
  page.line_size = line_style.size;
  page.title = figure.title;
  page.paint = [&figure, width = page.width, label_width](cairo_t* cairo) {
    paint(figure, cairo, width, label_width);
  };
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
