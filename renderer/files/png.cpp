#include "renderer/files/png.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "renderer/files/file_writer.h"

namespace quartet {

// libpng's simplified interface (png_image_*) reports errors by return value; the full one would
// longjmp across C++ objects.

void write_png(const std::filesystem::path& path, const DisplayImage& image) {
  if (image.empty()) {
    throw std::runtime_error(fmt::format("cannot write {}: the image has no pixels, it is {}x{}",
                                         path.string(), image.width(), image.height()));
  }
  const bool opaque =
      std::ranges::all_of(image.pixels(), [](const Rgba8& pixel) { return pixel.a == 255; });
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.size() * 4);
  for (const Rgba8& pixel : image.pixels()) {
    bytes.insert(bytes.end(), {pixel.r, pixel.g, pixel.b});
    if (!opaque) {
      bytes.push_back(pixel.a);
    }
  }

  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = png_uint_32(image.width());
  png.height = png_uint_32(image.height());
  png.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  // Encoded in memory, so that only FileWriter has to do with the disk.
  std::vector<std::uint8_t> encoded(PNG_IMAGE_PNG_SIZE_MAX(png));
  png_alloc_size_t size = encoded.size();
  if (png_image_write_to_memory(&png, encoded.data(), &size, 0, bytes.data(), 0, nullptr) == 0) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), png.message));
  }
  FileWriter file(path);
  file.write(encoded.data(), size);
  file.close();
}

DisplayImage read_png(const std::filesystem::path& path) {
  const auto fail = [&](const char* reason) -> std::runtime_error {
    return std::runtime_error(fmt::format("cannot read {} as PNG: {}", path.string(), reason));
  };
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) {
    throw fail(png.message);
  }
  png.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> bytes;
  try {
    bytes.resize(PNG_IMAGE_SIZE(png));
  } catch (...) {
    png_image_free(&png);
    throw;
  }
  if (png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr) == 0) {
    throw fail(png.message);
  }
  DisplayImage image(int(png.width), int(png.height));
  for (std::size_t i = 0; i < image.size(); ++i) {
    image.pixels()[i] = {bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]};
  }
  return image;
}

}  // namespace quartet
