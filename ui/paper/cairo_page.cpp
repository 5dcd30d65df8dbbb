#include "ui/paper/cairo_page.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <stdexcept>

#include "renderer/files/file_writer.h"
#include "renderer/files/png.h"
#include "ui/paper/figure_text.h"

namespace quartet {

namespace {

using CairoSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Cairo = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

constexpr double pdf_line_points = 7.0;  // a paper's caption, at the size of the page's lines

CairoSurface owned(cairo_surface_t* surface) {
  return {surface, cairo_surface_destroy};
}

void paint_page(cairo_t* cairo, const CairoPage& page) {
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
  page.paint(cairo);
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
      const auto byte = [&](int shift) { return std::uint8_t(row[x] >> shift); };
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
void write_vector(const CairoPage& page, const std::filesystem::path& path, CreateSurface create,
                  Prepare prepare) {
  const double points = pdf_line_points / page.line_size;
  FileWriter file(path);
  const CairoSurface surface =
      owned(create(write_bytes, &file, page.width * points, page.height * points));
  prepare(surface.get());
  const Cairo cairo(cairo_create(surface.get()), cairo_destroy);
  cairo_scale(cairo.get(), points, points);
  try {
    paint_page(cairo.get(), page);
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

void paint_text(cairo_t* cairo, const PlacedText& text) {
  select_font(cairo, text.style);
  cairo_set_source_rgb(cairo, text.style.gray, text.style.gray, text.style.gray);
  cairo_move_to(cairo, text.box.x, text.baseline);
  cairo_show_text(cairo, text.text.c_str());
}

void write_page_png(const CairoPage& page, const std::filesystem::path& path) {
  if (page.width > max_cairo_side || page.height > max_cairo_side) {
    throw std::runtime_error(fmt::format(
        "cannot write {}: a figure of {:.0f}x{:.0f} pixels is too large; smaller panels, so that "
        "it stays within {}x{}, would be right",
        path.string(), page.width, page.height, max_cairo_side, max_cairo_side));
  }
  const CairoSurface surface =
      owned(cairo_image_surface_create(CAIRO_FORMAT_RGB24, int(page.width), int(page.height)));
  const Cairo cairo(cairo_create(surface.get()), cairo_destroy);
  paint_page(cairo.get(), page);
  if (const cairo_status_t status = cairo_status(cairo.get()); status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(
        fmt::format("cannot write {}: {}", path.string(), cairo_status_to_string(status)));
  }
  write_png(path, image_of(surface.get()));
}

void write_page_pdf(const CairoPage& page, const std::filesystem::path& path) {
  write_vector(page, path, cairo_pdf_surface_create_for_stream, [&](cairo_surface_t* surface) {
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE,
                                   clean_text(page.title).c_str());
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, "quartet");
    // Cairo would put the time of writing here, and the same figure would give other bytes.
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  });
}

void write_page_svg(const CairoPage& page, const std::filesystem::path& path) {
  write_vector(page, path, cairo_svg_surface_create_for_stream, [](cairo_surface_t*) {});
}

}  // namespace quartet
