#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "renderer/base/image.h"

namespace quartet {

/// One channel, rows from the top left. Names of ours are stable: R G B (linear, Rec. 709),
/// SampleCount, Error.<estimator>, Variance.R, Variance.G, Variance.B (or what sampler_row.h calls
/// it), SquaredError, Rejected. Counts that people look at are floats too, exact up to 2^24:
/// OpenImageIO, and so what is built on it, reads channels of integers as 0. Integers are for what
/// only we read again.
struct ExrChannel {
  std::string name;
  std::variant<std::vector<float>, std::vector<std::uint32_t>> pixels;
  bool half = false;  ///< floats are stored in 16 bits; those read from a half are exact in float
};

/// A rectangle of pixels in EXR's plane: its first pixel and its size.
struct ExrWindow {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const ExrWindow&) const = default;
};

/// What lies in both; empty if nothing does.
ExrWindow intersection(const ExrWindow& a, const ExrWindow& b);

/// What an EXR file holds: planar channels over the data window, and the text attributes of the
/// header. The display window is the picture as it is meant to be seen; most files have both the
/// same, cropped or overscanned ones do not.
struct ExrImage {
  ExrWindow data;
  ExrWindow display;
  std::vector<ExrChannel> channels;
  std::map<std::string, std::string> attributes;
  bool rec709 = true;  ///< as read: whether its R, G and B are those of Rec. 709

  ExrImage() = default;
  ExrImage(int width, int height) : data{0, 0, width, height}, display{0, 0, width, height} {}

  int width() const { return data.width; }
  int height() const { return data.height; }
  const ExrChannel* find(std::string_view name) const;  ///< null if there is none

  void add(std::string name, std::vector<float> pixels);
  void add(std::string name, std::vector<std::uint32_t> pixels);
  void add_radiance(const RadianceImage& radiance);  ///< channels R, G, B
};

/// Throws std::runtime_error with the limits if an EXR of this size could be written but not read
/// again.
void check_exr_size(int width, int height, std::size_t channels);

/// Writes scanlines, losslessly compressed (ZIP). The same image gives the same bytes. Throws
/// std::runtime_error that names the path and the reason, also where read_exr would refuse it.
void write_exr(const std::filesystem::path& path, const ExrImage& image);

/// Reads the first part of any scanline or tiled file: all half, float and uint channels, in the
/// file's order of names. Takes no more memory than the file's bytes can become by decompression.
/// Throws std::runtime_error that names the path, what is wrong and what would be right (not an
/// EXR, no regular file, truncated, deep, subsampled channels, absurd size), and Cancelled soon
/// after a stop was asked for.
ExrImage read_exr(const std::filesystem::path& path, const std::stop_token& stop = {});

/// What a file says of a part before its pixels are read. A file with one part does not name it.
struct ExrPartHeader {
  std::string name;
  std::vector<std::string> channels;
  std::map<std::string, std::string> attributes;
};

/// Whether a file begins with the first bytes of EXR. Throws std::runtime_error that names the path
/// if it cannot be read.
bool begins_as_exr(const std::filesystem::path& path);

/// The headers of all parts, throwing as read_exr does; deep and subsampled ones among them.
std::vector<ExrPartHeader> read_exr_headers(const std::filesystem::path& path);

/// As read_exr, only these channels of one part, as read_exr_headers gave them. Other channels take
/// no memory.
ExrImage read_exr_channels(const std::filesystem::path& path, std::size_t part,
                           const std::vector<std::string>& channels,
                           const std::stop_token& stop = {});

/// The channels R, G, B of an image that was read from `path`, within its display window: what
/// other programs render beyond its edges is left out. Throws std::runtime_error that names the
/// path if one is missing (with the names there are), or if the data window leaves out a part of
/// the picture: what is there would be a guess.
RadianceImage radiance_of(const ExrImage& image, const std::filesystem::path& path);

}  // namespace quartet
