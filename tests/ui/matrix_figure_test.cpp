#include "ui/paper/matrix_figure.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <tuple>

#include "renderer/files/png.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

MatrixFigure figure_of(std::size_t rows, std::size_t columns) {
  MatrixFigure figure;
  figure.title = "How each fails";
  figure.lines = {
      "A line below the title that is long enough to be broken where the page ends, "
      "whatever the page's width is, because it goes on and on."};
  for (std::size_t i = 0; i < rows; ++i) {
    figure.rows.push_back("case " + std::to_string(i));
  }
  for (std::size_t i = 0; i < columns; ++i) {
    figure.columns.push_back("estimator-" + std::to_string(i));
  }
  for (const char* title : {"first", "second"}) {
    MatrixFigure::Panel panel{title, {}};
    for (std::size_t i = 0; i < rows * columns; ++i) {
      panel.cells.push_back({"−12 %", {}, {std::uint8_t(10 + 7 * i), 100, 50}});
    }
    figure.panels.push_back(panel);
  }
  figure.legend = {{{200, 10, 10}, "bad", "It is bad."}, {{10, 120, 10}, "good", "It is not."}};
  figure.footer = "quartet stability --out out";
  return figure;
}

std::map<std::tuple<int, int, int>, int> colors_of(const DisplayImage& image) {
  std::map<std::tuple<int, int, int>, int> colors;
  for (const Rgba8& pixel : image.pixels()) {
    ++colors[{pixel.r, pixel.g, pixel.b}];
  }
  return colors;
}

TEST(MatrixFigure, ShowsEveryCellOfEveryPanelAndTheLegend) {
  const TempFolder folder;
  const MatrixFigure figure = figure_of(5, 6);
  write_matrix_png(figure, folder / "m.png");
  auto colors = colors_of(read_png(folder / "m.png"));
  for (const MatrixFigure::Cell& cell : figure.panels.front().cells) {
    // Most of two cells of 70 × 23 pixels, the rest is text.
    const int pixels = colors[{cell.color.r, cell.color.g, cell.color.b}];
    EXPECT_GT(pixels, 2 * 70 * 23 * 6 / 10);
    EXPECT_LE(pixels, 2 * 70 * 23);
  }
  for (const MatrixFigure::Entry& entry : figure.legend) {
    EXPECT_GT((colors[{entry.color.r, entry.color.g, entry.color.b}]), 100);
  }
}

TEST(MatrixFigure, NothingLeavesThePage) {
  const TempFolder folder;
  for (const auto& [rows, columns] : {std::pair{1, 1}, {18, 12}, {3, 40}}) {
    write_matrix_png(figure_of(std::size_t(rows), std::size_t(columns)), folder / "m.png");
    const DisplayImage image = read_png(folder / "m.png");
    const auto white = [](const Rgba8& pixel) { return pixel == Rgba8{255, 255, 255, 255}; };
    for (int y = 0; y < image.height(); ++y) {
      EXPECT_TRUE(white(image.at(4, y)) && white(image.at(image.width() - 4, y))) << y;
    }
    for (int x = 0; x < image.width(); ++x) {
      EXPECT_TRUE(white(image.at(x, 4)) && white(image.at(x, image.height() - 4))) << x;
    }
  }
}

TEST(MatrixFigure, TheSameFigureGivesTheSameBytes) {
  const TempFolder folder;
  const MatrixFigure figure = figure_of(4, 3);
  write_matrix_pdf(figure, folder / "a.pdf");
  write_matrix_pdf(figure, folder / "b.pdf");
  EXPECT_TRUE(bytes_of(folder / "a.pdf").starts_with("%PDF"));
  EXPECT_EQ(bytes_of(folder / "a.pdf"), bytes_of(folder / "b.pdf"));
}

}  // namespace
}  // namespace quartet
