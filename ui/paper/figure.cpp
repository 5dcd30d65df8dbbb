#include "ui/paper/figure.h"

#include <cairo.h>
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <stdexcept>

#include "ui/paper/cairo_page.h"
#include "ui/paper/figure_layout.h"

namespace quartet {

namespace {

using PictureSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

std::uint32_t over_white(std::uint8_t value, std::uint8_t alpha) {
  return std::uint32_t(255 + (int(value) - 255) * int(alpha) / 255);
}

PictureSurface surface_of(const DisplayImage& image) {
  PictureSurface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width(), image.height()),
      cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(
        fmt::format("a picture of {}x{} is too large for a figure; at most {}x{} would be right",
                    image.width(), image.height(), max_cairo_side, max_cairo_side));
  }
  cairo_surface_flush(surface.get());
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < image.height(); ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + y * stride);
    for (int x = 0; x < image.width(); ++x) {
      const Rgba8 c = image.at(x, y);
      row[x] = over_white(c.r, c.a) << 16 | over_white(c.g, c.a) << 8 | over_white(c.b, c.a);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

void paint_image(cairo_t* cairo, const DisplayImage& image, const Rect& box) {
  const PictureSurface surface = surface_of(image);
  cairo_save(cairo);
  cairo_rectangle(cairo, box.x, box.y, box.width, box.height);
  cairo_clip(cairo);
  cairo_translate(cairo, box.x, box.y);
  cairo_scale(cairo, box.width / image.width(), box.height / image.height());
  cairo_set_source_surface(cairo, surface.get(), 0, 0);
  // Pixels stay squares; it also keeps viewers from smoothing the PDF.
  cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_NEAREST);
  cairo_paint(cairo);
  cairo_restore(cairo);
}

void paint_colors(cairo_t* cairo, const PlacedColors& bar) {
  constexpr int steps = 1024;
  DisplayImage colors(steps, 1);
  for (int x = 0; x < steps; ++x) {
    colors.at(x, 0) = sample(bar.color_map, float(x) / float(steps - 1));
  }
  paint_image(cairo, colors, bar.box);
}

void paint(cairo_t* cairo, const FigureLayout& layout) {
  for (const PlacedImage& image : layout.images) {
    // A hairline around it, so that a white picture has an edge on white paper.
    cairo_set_source_rgb(cairo, 0.8, 0.8, 0.8);
    cairo_set_line_width(cairo, 1);
    cairo_rectangle(cairo, image.box.x - 0.5, image.box.y - 0.5, image.box.width + 1,
                    image.box.height + 1);
    cairo_stroke(cairo);
    paint_image(cairo, *image.image, image.box);
  }
  for (const PlacedColors& bar : layout.bars) {
    paint_colors(cairo, bar);
  }
  for (const PlacedFill& fill : layout.fills) {
    cairo_set_source_rgb(cairo, fill.color.r / 255.0, fill.color.g / 255.0, fill.color.b / 255.0);
    cairo_rectangle(cairo, fill.box.x, fill.box.y, fill.box.width, fill.box.height);
    cairo_fill(cairo);
  }
  for (const PlacedText& text : layout.titles) {
    paint_text(cairo, text);
  }
  for (const PlacedText& text : layout.texts) {
    paint_text(cairo, text);
  }
}

CairoPage page_of(const Figure& figure) {
  const FigureLayout layout = lay_out(figure);
  return {layout.width, layout.height, layout.line_size, figure.title,
          [layout](cairo_t* cairo) { paint(cairo, layout); }};
}

}  // namespace

void write_figure_png(const Figure& figure, const std::filesystem::path& path) {
  write_page_png(page_of(figure), path);
}

void write_figure_pdf(const Figure& figure, const std::filesystem::path& path) {
  write_page_pdf(page_of(figure), path);
}

void write_figure_svg(const Figure& figure, const std::filesystem::path& path) {
  write_page_svg(page_of(figure), path);
}

}  // namespace quartet
