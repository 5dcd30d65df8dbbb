// Portable float maps, as P. Debevec's HDR Shop wrote them first: three words (PF or Pf, the sides,
// a scale whose sign tells the order of bytes), then rows of floats from the bottom up.

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/base/cancel.h"
#include "renderer/files/picture_formats.h"

namespace quartet {
namespace {

bool is_pfm_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// The next word and the one white space behind it: what follows the last is pixels. ImageMagick
/// writes comments, as the formats have that PFM comes from: from # to the end of the line.
std::string pfm_word(FileReader& file) {
  constexpr std::size_t longest = 64;
  std::string word;
  for (;;) {
    char c = '\0';
    file.read(&c, 1);
    if (c == '#' && word.empty()) {
      read_header_line(file);
    } else if (!is_pfm_space(c)) {
      word += c;
    } else if (!word.empty()) {
      return word;
    }
    if (word.size() > longest) {
      throw std::runtime_error(fmt::format("a word of its header has more than {} bytes", longest));
    }
  }
}

template <class T>
T pfm_number(FileReader& file, const char* what) {
  const std::string word = pfm_word(file);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    throw std::runtime_error(fmt::format("'{}' in its header is no {}", word, what));
  }
  return value;
}

/// A header with line ends of two bytes ends one byte after the white space that the format asks
/// for; that byte is told from a pixel's by the size of the file.
void skip_second_byte_of_line_end(FileReader& file, std::uint64_t pixel_bytes) {
  if (file.left() != pixel_bytes + 1) {
    return;
  }
  const std::uint64_t first = file.position();
  std::array<char, 2> end{};
  file.seek(first - 1);
  file.read(end.data(), end.size());
  if (end != std::array{'\r', '\n'}) {
    file.seek(first);
  }
}

std::uint32_t swapped(std::uint32_t bits) {
  return bits >> 24 | (bits >> 8 & 0xff00u) | (bits << 8 & 0xff0000u) | bits << 24;
}

}  // namespace

Picture read_pfm_picture(FileReader& file, const std::stop_token& stop) {
  const std::string kind = pfm_word(file);
  if (kind != "PF" && kind != "Pf") {
    throw std::runtime_error(
        fmt::format("it begins with '{}'; PF (colour) or Pf (luminance) would be right", kind));
  }
  const std::size_t channels = kind == "PF" ? 3 : 1;
  const auto width = pfm_number<std::uint32_t>(file, "width");
  const auto height = pfm_number<std::uint32_t>(file, "height");
  const auto scale = pfm_number<double>(file, "scale");
  if (!std::isfinite(scale) || scale == 0.0) {
    throw std::runtime_error(fmt::format(
        "its scale is {}; -1 (low byte first) or 1 (high byte first) would be right", scale));
  }
  const std::size_t pixel_bytes = channels * sizeof(float);
  skip_second_byte_of_line_end(file, std::uint64_t(width) * height * pixel_bytes);
  check_claimed_size(width, height, 1.0 / double(pixel_bytes), file.left());

  Picture picture = whole_picture(width, height);
  std::vector<std::uint32_t> row(channels * width);
  for (int y = picture.height - 1; y >= 0; --y) {
    check_cancelled(stop);
    file.read(row.data(), row.size() * sizeof(std::uint32_t));
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t bits =
            row[channels * std::size_t(x) + (channels == 1 ? 0u : unsigned(c))];
        picture.image.at(x, y)[c] = std::bit_cast<float>(scale < 0.0 ? bits : swapped(bits));
      }
    }
  }
  if (channels == 1) {
    picture.notes.emplace_back("it has luminance alone, which is taken for R, G and B alike");
  }
  if (std::abs(scale) != 1.0) {
    picture.notes.push_back(fmt::format(
        "its scale {} is not applied: programs differ in what it means", std::abs(scale)));
  }
  if (file.left() > 0) {
    picture.notes.push_back(fmt::format("{} bytes behind its last pixel are ignored", file.left()));
  }
  return picture;
}

}  // namespace quartet
