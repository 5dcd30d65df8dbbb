#pragma once

#include <cairo.h>

#include <filesystem>
#include <functional>
#include <string>

#include "ui/paper/figure_layout.h"

namespace quartet {

/// One page of paper that is painted the same into each kind of file.
struct CairoPage {
  double width = 0, height = 0;  ///< in pixels of the PNG
  double line_size = 0;          ///< of its lines of text; in a PDF they are as large as captions
  std::string title;             ///< in the PDF's properties
  /// Paints it, in pixels of the PNG, on white paper.
  std::function<void(cairo_t*)> paint;
};

/// PNG and PDF: the same page gives the same bytes. Each throws std::runtime_error that names the
/// path and the reason, such as a full disk.
void write_page_png(const CairoPage& page, const std::filesystem::path& path);
void write_page_pdf(const CairoPage& page, const std::filesystem::path& path);
void write_page_svg(const CairoPage& page, const std::filesystem::path& path);

inline constexpr int max_cairo_side = 32767;

void paint_text(cairo_t* cairo, const PlacedText& text);

}  // namespace quartet
