#include "ui/figure.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "renderer/image/file_writer.h"
#include "renderer/image/png.h"
#include "ui/figure_layout.h"
#include "ui/figure_text.h"

namespace quartet {

namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Cairo = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

constexpr double kPdfLinePoints = 7.0;  // a paper's caption, at the size of the panels' lines
constexpr int kMaxCairoSide = 32767;

Surface owned(cairo_surface_t* surface) {
  return {surface, cairo_surface_destroy};
}

std::uint32_t over_white(std::uint8_t value, std::uint8_t alpha) {
  return static_cast<std::uint32_t>(255 + (int(value) - 255) * int(alpha) / 255);
}

Surface surface_of(const DisplayImage& image) {
  Surface surface =
      owned(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width(), image.height()));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(
        fmt::format("a picture of {}x{} is too large for a figure; at most {}x{} would be right",
                    image.width(), image.height(), kMaxCairoSide, kMaxCairoSide));
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
  const Surface surface = surface_of(image);
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
  constexpr int kSteps = 1024;
  DisplayImage colors(kSteps, 1);
  for (int x = 0; x < kSteps; ++x) {
    colors.at(x, 0) = sample(bar.color_map, static_cast<float>(x) / static_cast<float>(kSteps - 1));
  }
  paint_image(cairo, colors, bar.box);
}

void paint_text(cairo_t* cairo, const PlacedText& text) {
  select_font(cairo, text.style);
  cairo_set_source_rgb(cairo, text.style.gray, text.style.gray, text.style.gray);
  cairo_move_to(cairo, text.box.x, text.baseline);
  cairo_show_text(cairo, text.text.c_str());
}

void paint(cairo_t* cairo, const FigureLayout& layout) {
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
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

DisplayImage image_of(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  DisplayImage image(cairo_image_surface_get_width(surface),
                     cairo_image_surface_get_height(surface));
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < image.height(); ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(data + y * stride);
    for (int x = 0; x < image.width(); ++x) {
      const auto byte = [&](int shift) { return static_cast<std::uint8_t>(row[x] >> shift); };
      image.at(x, y) = {byte(16), byte(8), byte(0), 255};
    }
  }
  return image;
}

/// Cairo is C: an exception must not pass through it. FileWriter keeps the error for close().
cairo_status_t write_bytes(void* file, const unsigned char* bytes, unsigned size) {
  try {
    static_cast<FileWriter*>(file)->write(bytes, size);
    return CAIRO_STATUS_SUCCESS;
  } catch (const std::exception&) {
    return CAIRO_STATUS_WRITE_ERROR;
  }
}

using CreateSurface = cairo_surface_t* (*)(cairo_write_func_t, void*, double, double);

/// PDF or SVG, in points.
template <class Prepare>
void write_vector(const Figure& figure, const std::filesystem::path& path, CreateSurface create,
                  Prepare prepare) {
  const FigureLayout layout = lay_out(figure);
  const double points = kPdfLinePoints / layout.line_size;
  FileWriter file(path);
  const Surface surface =
      owned(create(write_bytes, &file, layout.width * points, layout.height * points));
  prepare(surface.get());
  const Cairo cairo(cairo_create(surface.get()), cairo_destroy);
  cairo_scale(cairo.get(), points, points);
  try {
    paint(cairo.get(), layout);
  } catch (const std::runtime_error& error) {
    file.fail(error.what());
  }
  const cairo_status_t painted = cairo_status(cairo.get());
  cairo_surface_finish(surface.get());
  const cairo_status_t finished = cairo_surface_status(surface.get());
  for (const cairo_status_t status : {painted, finished}) {
    if (status != CAIRO_STATUS_SUCCESS) {
      file.fail(cairo_status_to_string(status));
    }
  }
  file.close();
}

}  // namespace

void write_figure_png(const Figure& figure, const std::filesystem::path& path) {
  const FigureLayout layout = lay_out(figure);
  if (layout.width > kMaxCairoSide || layout.height > kMaxCairoSide) {
    throw std::runtime_error(fmt::format(
        "cannot write {}: a figure of {:.0f}x{:.0f} pixels is too large; smaller panels, so that "
        "it stays within {}x{}, would be right",
        path.string(), layout.width, layout.height, kMaxCairoSide, kMaxCairoSide));
  }
  const Surface surface = owned(cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(layout.width), static_cast<int>(layout.height)));
  const Cairo cairo(cairo_create(surface.get()), cairo_destroy);
  paint(cairo.get(), layout);
  if (const cairo_status_t status = cairo_status(cairo.get()); status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(
        fmt::format("cannot write {}: {}", path.string(), cairo_status_to_string(status)));
  }
  write_png(path, image_of(surface.get()));
}

void write_figure_pdf(const Figure& figure, const std::filesystem::path& path) {
  write_vector(figure, path, cairo_pdf_surface_create_for_stream, [&](cairo_surface_t* surface) {
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE,
                                   clean_text(figure.title).c_str());
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, "quartet");
    // Cairo would put the time of writing here, and the same figure would give other bytes.
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  });
}

void write_figure_svg(const Figure& figure, const std::filesystem::path& path) {
  write_vector(figure, path, cairo_svg_surface_create_for_stream, [](cairo_surface_t*) {});
}

}  // namespace quartet
