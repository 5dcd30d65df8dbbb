#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/base/image.h"

namespace quartet {

/// A table of coloured cells for a report: the same rows and columns in each of its panels, which
/// stand below each other. Text is UTF-8.
struct MatrixFigure {
  struct Cell {
    std::string text;                ///< short: a number with its unit
    std::vector<std::string> small;  ///< lines below it
    Rgba8 color;                     ///< dark enough for white text
  };
  struct Panel {
    std::string title;
    std::vector<Cell> cells;  ///< row by row
  };
  /// What a colour means.
  struct Entry {
    Rgba8 color;
    std::string label;
    std::string rule;  ///< one sentence
  };

  std::string title;
  std::vector<std::string> lines;  ///< below the title
  std::vector<std::string> rows;
  std::vector<std::string> columns;
  std::vector<Panel> panels;
  std::vector<Entry> legend;
  std::string footer;  ///< settings, command line
};

/// Painted from one layout, with the guarantees of a Figure.
void write_matrix_png(const MatrixFigure& figure, const std::filesystem::path& path);
void write_matrix_pdf(const MatrixFigure& figure, const std::filesystem::path& path);

}  // namespace quartet
