// Radiance's pictures: G. Ward, "Real Pixels", Graphics Gems II, 1991, and the manual page
// "filefmts" of Radiance. A pixel is three mantissas and an exponent that they share.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/cancel.h"
#include "renderer/files/picture_formats.h"

namespace quartet {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

struct HdrHeader {
  bool y_first = true;  ///< scanlines are rows
  bool up = false;      ///< y grows from one pixel to the next
  bool left = false;    ///< x falls
  std::uint32_t width = 0, height = 0;
  double exposure = 1.0;                      ///< that the numbers were multiplied by
  std::array<double, 3> correction{1, 1, 1};  ///< the same, a channel
  bool rec709 = true;
};

template <std::size_t Count>
std::array<double, Count> hdr_numbers(std::string_view line, std::string_view text) {
  std::array<double, Count> values{};
  for (double& value : values) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !std::isfinite(value)) {
      throw std::runtime_error(
          fmt::format("'{}' in its header is not {} numbers", line, values.size()));
    }
    text.remove_prefix(std::size_t(end - text.data()));
  }
  return values;
}

double hdr_factor(std::string_view line, double value) {
  if (!(value > 0.0)) {
    throw std::runtime_error(
        fmt::format("'{}' in its header; a number above 0 would be right", line));
  }
  return value;
}

void read_hdr_line(std::string_view line, HdrHeader& header) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos || line.starts_with('#')) {
    return;  // a comment, or the command that made it
  }
  const std::string_view name = line.substr(0, equals);
  const std::string_view value = line.substr(equals + 1);
  if (name == "FORMAT") {
    if (!value.starts_with("32-bit_rle_rgbe")) {
      throw std::runtime_error(
          fmt::format("its format is '{}'; 32-bit_rle_rgbe would be right", value));
    }
  } else if (name == "EXPOSURE") {
    header.exposure *= hdr_factor(line, hdr_numbers<1>(line, value)[0]);
  } else if (name == "COLORCORR") {
    const auto factors = hdr_numbers<3>(line, value);
    for (std::size_t c = 0; c < 3; ++c) {
      header.correction[c] *= hdr_factor(line, factors[c]);
    }
  } else if (name == "PRIMARIES") {
    constexpr std::array<double, 8> rec709{0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
    const auto found = hdr_numbers<8>(line, value);
    header.rec709 = std::ranges::equal(found, rec709,
                                       [](double a, double b) { return std::abs(a - b) < 1e-3; });
  }
}

/// "-Y 54 +X 96": the axis of the scanlines first, each with the way it goes; y is up.
void read_hdr_size(const std::string& line, HdrHeader& header) {
  const auto fail = [&] {
    throw std::runtime_error(
        fmt::format("'{}' is no size of a picture; '-Y HEIGHT +X WIDTH' would be right", line));
  };
  const char* at = line.data();
  const char* const end = line.data() + line.size();
  std::string axes;
  for (int i = 0; i < 2; ++i) {
    if (end - at < 4 || (at[0] != '+' && at[0] != '-') || (at[1] != 'X' && at[1] != 'Y') ||
        at[2] != ' ') {
      fail();
    }
    const bool rises = at[0] == '+';
    const char axis = at[1];
    axes += axis;
    std::uint32_t& side = axis == 'X' ? header.width : header.height;
    (axis == 'X' ? header.left : header.up) = axis == 'X' ? !rises : rises;
    const auto [after, error] = std::from_chars(at + 3, end, side);
    if (error != std::errc() || (i == 0 && (after == end || *after != ' '))) {
      fail();
    }
    at = after + (i == 0 ? 1 : 0);
  }
  if (axes == "XX" || axes == "YY" || (at != end && *at != '\r')) {
    fail();
  }
  header.y_first = axes == "YX";
}

HdrHeader read_hdr_header(FileReader& file) {
  HdrHeader header;
  read_header_line(file);  // #?RADIANCE, or the name of another program
  for (std::string line = read_header_line(file); !line.empty() && line != "\r";
       line = read_header_line(file)) {
    read_hdr_line(line, header);
  }
  read_hdr_size(read_header_line(file), header);
  return header;
}

/// Bytes of one kind after the other, in runs: 128 + n and a byte n times, or n and n bytes.
void read_runs(FileReader& file, std::vector<Rgbe>& line) {
  constexpr std::uint8_t longest = 128;
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t i = 0; i < line.size();) {
      std::array<std::uint8_t, longest> bytes{};
      std::uint8_t code = 0;
      file.read(&code, 1);
      const bool run = code > longest;
      const std::size_t count = run ? code - longest : code;
      if (count == 0 || count > line.size() - i) {
        throw std::runtime_error(fmt::format(
            "a run of {} bytes does not fit its scanline of {} pixels", count, line.size()));
      }
      file.read(bytes.data(), run ? 1 : count);
      for (std::size_t k = 0; k < count; ++k) {
        line[i++][c] = bytes[run ? 0 : k];
      }
    }
  }
}

/// Pixels one by one, where (1, 1, 1, n) repeats the one before n times; right behind another such,
/// 256 times as often.
void read_flat(FileReader& file, std::vector<Rgbe>& line, const Rgbe& first) {
  Rgbe pixel = first;
  unsigned shift = 0;
  for (std::size_t i = 0;;) {
    if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
      const std::size_t count = std::size_t(pixel[3]) << shift;
      if (i == 0 || shift > 16 || count > line.size() - i) {
        throw std::runtime_error(
            fmt::format("a run of {} pixels does not fit its scanline of {}", count, line.size()));
      }
      std::fill_n(line.begin() + std::ptrdiff_t(i), count, line[i - 1]);
      i += count;
      shift += 8;
    } else {
      line[i++] = pixel;
      shift = 0;
    }
    if (i == line.size()) {
      return;
    }
    file.read(pixel.data(), pixel.size());
  }
}

void read_scanline(FileReader& file, std::vector<Rgbe>& line) {
  constexpr std::size_t least_of_runs = 8;
  constexpr std::size_t most_of_runs = 0x7fff;
  Rgbe first{};
  file.read(first.data(), first.size());
  const std::size_t claimed = std::size_t(first[2]) << 8 | first[3];
  if (line.size() >= least_of_runs && line.size() <= most_of_runs && first[0] == 2 &&
      first[1] == 2 && first[2] < 128) {
    if (claimed != line.size()) {
      throw std::runtime_error(
          fmt::format("a scanline claims {} pixels; {} would be right", claimed, line.size()));
    }
    read_runs(file, line);
  } else {
    read_flat(file, line, first);
  }
}

/// Without the half that Radiance itself adds to mantissas: 0 to 1 come back as they were, and as
/// other programs read them.
glm::vec3 radiance_of_rgbe(const Rgbe& pixel, const glm::dvec3& factor) {
  if (pixel[3] == 0) {
    return glm::vec3(0.0f);
  }
  constexpr int bias = 128 + 8;
  const double unit = std::ldexp(1.0, int(pixel[3]) - bias);
  return {glm::dvec3(pixel[0], pixel[1], pixel[2]) * unit * factor};
}

}  // namespace

Picture read_hdr_picture(FileReader& file, const std::stop_token& stop) {
  const HdrHeader header = read_hdr_header(file);
  // Four bytes and runs of up to 255, 65 280 and so on pixels: 12 bytes make the longest line.
  constexpr double pixels_a_byte = 65536.0 / 12.0;
  check_claimed_size(header.width, header.height, pixels_a_byte, file.left());
  Picture picture = whole_picture(header.width, header.height);
  const glm::dvec3 factor =
      1.0 / (header.exposure *
             glm::dvec3(header.correction[0], header.correction[1], header.correction[2]));
  const int lines = header.y_first ? picture.height : picture.width;
  std::vector<Rgbe> line(std::size_t(header.y_first ? picture.width : picture.height));
  for (int i = 0; i < lines; ++i) {
    check_cancelled(stop);
    read_scanline(file, line);
    for (int k = 0; k < int(line.size()); ++k) {
      const int x = header.y_first ? k : i;
      const int y = header.y_first ? i : k;
      picture.image.at(header.left ? picture.width - 1 - x : x,
                       header.up ? picture.height - 1 - y : y) =
          radiance_of_rgbe(line[std::size_t(k)], factor);
    }
  }
  if (factor != glm::dvec3(1.0)) {
    picture.notes.emplace_back("the exposure and colour correction of its header are undone");
  }
  if (!header.rec709) {
    picture.notes.emplace_back(
        "its primaries are not those of Rec. 709; its numbers are taken as they are");
  }
  if (file.left() > 0) {
    picture.notes.push_back(fmt::format("{} bytes behind its last pixel are ignored", file.left()));
  }
  return picture;
}

}  // namespace quartet
