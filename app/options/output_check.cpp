#include "app/options/output_check.h"

#include <fmt/format.h>

#include <stdexcept>

#include "app/options/usage_error.h"
#include "renderer/files/exr.h"

namespace quartet {

void add_out_option(CLI::App& command, std::string& folder) {
  command.add_option("--out", folder, "Folder for the files, made if need be")->required();
}

void check_picture_size(const std::string& option, int width, int height,
                        const std::filesystem::path& file, std::size_t channels) {
  constexpr int most_png_side = 1'000'000;     // libpng's own limit
  constexpr double most_png_pixels = 1 << 29;  // it counts bytes, 4 a pixel, in an int
  if (file.extension() != ".png") {
    try {
      check_exr_size(width, height, channels);
    } catch (const std::runtime_error& error) {
      throw UsageError(fmt::format("{}: {}", option, error.what()));
    }
  } else if (width > most_png_side || height > most_png_side ||
             double(width) * double(height) > most_png_pixels) {
    throw UsageError(
        fmt::format("{0}: {1}x{2} is too large for a .png; at most {3}x{3}, and {4:.0f} pixels in "
                    "all, would be right",
                    option, width, height, most_png_side, most_png_pixels));
  }
}

}  // namespace quartet
