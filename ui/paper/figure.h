#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/view/color_bar.h"

namespace quartet {

struct FigurePanel {
  DisplayImage image;  ///< at least one pixel
  std::string title;
  std::vector<std::string> lines;  ///< below the title
  std::optional<ColorBar> bar;     ///< if the panel has a scale of its own
};

/// A figure for a report: labelled panels in a grid, in rows from the top left, all in cells of
/// one size. Text is UTF-8.
struct Figure {
  std::string title;
  std::vector<FigurePanel> panels;
  int columns = 2;
  std::optional<ColorBar> shared_bar;  ///< if one scale holds for all panels
  std::string footer;                  ///< settings, command line
};

/// Painted from one layout. In the PNG every picture has its own pixels, small ones each enlarged
/// to a whole square of pixels; in PDF and SVG pictures are lossless and, in the PDF, text is text,
/// at the size of a paper's captions. PNG and PDF: the same figure gives the same bytes. Each
/// throws std::runtime_error that names the path and the reason.
void write_figure_png(const Figure& figure, const std::filesystem::path& path);
void write_figure_pdf(const Figure& figure, const std::filesystem::path& path);
void write_figure_svg(const Figure& figure, const std::filesystem::path& path);

}  // namespace quartet
