#include "renderer/files/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "renderer/base/cancel.h"
#include "renderer/base/lower_case.h"
#include "renderer/files/exr_header.h"
#include "renderer/files/picture_formats.h"

namespace quartet {
namespace {

enum class PictureFormat { exr, png, pfm, hdr };

struct PictureFormatRow {
  PictureFormat key;
  std::string_view label;      ///< for people
  std::string_view extension;  ///< of names
  std::string_view begin;      ///< of every such file
};

constexpr std::array<PictureFormatRow, 5> picture_formats{{
    {PictureFormat::exr, "EXR", ".exr", "\x76\x2f\x31\x01"},
    {PictureFormat::png, "PNG", ".png", "\x89PNG\r\n\x1a\n"},
    {PictureFormat::pfm, "PFM", ".pfm", "PF"},
    {PictureFormat::pfm, "PFM", ".pfm", "Pf"},
    {PictureFormat::hdr, "Radiance HDR", ".hdr", "#?"},
}};

/// Null if it begins as no picture does. Throws std::runtime_error that names the path.
const PictureFormatRow* format_of(FileReader& file, const std::filesystem::path& path) {
  std::string begin(std::min<std::uint64_t>(8, file.size()), '\0');
  try {
    file.read(begin.data(), begin.size());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
  file.seek(0);
  const auto* const row = std::ranges::find_if(
      picture_formats, [&](const PictureFormatRow& r) { return begin.starts_with(r.begin); });
  return row == picture_formats.end() ? nullptr : row;
}

Picture read_as(PictureFormat format, FileReader& file, const std::stop_token& stop) {
  switch (format) {
    case PictureFormat::png:
      return read_png_picture(file, stop);
    case PictureFormat::pfm:
      return read_pfm_picture(file, stop);
    case PictureFormat::hdr:
      return read_hdr_picture(file, stop);
    case PictureFormat::exr:
      break;
  }
  throw std::logic_error("an EXR is read by its path");
}

}  // namespace

Picture read_picture(const std::filesystem::path& path, const PictureOptions& options,
                     const std::stop_token& stop) {
  FileReader file(path);
  const PictureFormatRow* format = format_of(file, path);
  if (format == nullptr) {
    throw std::runtime_error(
        fmt::format("cannot read {}: it begins as no picture that is known; EXR, PNG, PFM or "
                    "Radiance HDR would be right",
                    path.string()));
  }
  if (format->key == PictureFormat::exr) {
    return read_exr_picture(path, options, stop);
  }
  if (!options.layer.empty()) {
    throw std::runtime_error(fmt::format(
        "{} {}: {} is a {}, which has no layers; without {} "
        "it would be right",
        options.layer_option, options.layer, path.string(), format->label, options.layer_option));
  }
  try {
    return read_as(format->key, file, stop);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("cannot read {} as {}: {}", path.string(), format->label,
                                         one_line(error.what())));
  }
}

bool begins_as_exr(const std::filesystem::path& path) {
  FileReader file(path);
  const PictureFormatRow* format = format_of(file, path);
  return format != nullptr && format->key == PictureFormat::exr;
}

bool is_picture(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  if (std::ranges::find(picture_formats, extension, &PictureFormatRow::extension) !=
      picture_formats.end()) {
    return true;
  }
  try {
    FileReader file(path);
    return format_of(file, path) != nullptr;
  } catch (const std::runtime_error&) {
    return false;
  }
}

void check_claimed_size(std::uint64_t width, std::uint64_t height, double pixels_a_byte,
                        std::uint64_t bytes) {
  if (width < 1 || height < 1 || width > std::uint64_t(max_exr_side) ||
      height > std::uint64_t(max_exr_side) || width * height > max_exr_numbers / 3) {
    throw std::runtime_error(
        fmt::format("its header claims {}x{} pixels; sides of 1 to {} and at most {} million "
                    "pixels would be right",
                    width, height, max_exr_side, max_exr_numbers / 3'000'000));
  }
  if (double(width * height) > pixels_a_byte * double(bytes)) {
    throw std::runtime_error(
        fmt::format("its header claims {}x{} pixels, which do not fit the {} bytes that follow; it "
                    "is cut or damaged",
                    width, height, bytes));
  }
}

Picture whole_picture(std::uint64_t width, std::uint64_t height) {
  Picture picture;
  picture.width = int(width);
  picture.height = int(height);
  picture.image = RadianceImage(picture.width, picture.height);
  return picture;
}

std::string read_header_line(FileReader& file) {
  constexpr std::size_t longest = 4096;
  std::string line;
  for (;;) {
    char c = '\0';
    file.read(&c, 1);
    if (c == '\n') {
      return line;
    }
    if (line.size() == longest) {
      throw std::runtime_error(fmt::format("a line of its header has more than {} bytes", longest));
    }
    line += c;
  }
}

}  // namespace quartet
