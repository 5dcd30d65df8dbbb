#pragma once

#include <filesystem>

#include "renderer/base/image.h"

namespace quartet {

/// Writes 8-bit sRGB: RGB if every pixel is opaque, else RGBA. The same image gives the same bytes.
/// Throws std::runtime_error that names the path and the reason.
void write_png(const std::filesystem::path& path, const DisplayImage& image);

/// Reads any PNG as 8-bit sRGB. Throws std::runtime_error that names the path and the reason.
DisplayImage read_png(const std::filesystem::path& path);

}  // namespace quartet
