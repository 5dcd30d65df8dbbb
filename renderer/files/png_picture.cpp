// PNG as radiance. libpng's full interface, which keeps 16 bits and tells the transfer function;
// its errors jump over what is between, so that nothing between has a destructor.

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/base/cancel.h"
#include "renderer/files/picture_formats.h"
#include "renderer/files/srgb.h"

namespace quartet {
namespace {

/// What libpng is given and gives, through a jump or not.
struct PngReading {
  const std::uint8_t* bytes = nullptr;
  std::size_t size = 0;
  std::size_t position = 0;
  std::array<char, 256> error{};

  png_uint_32 width = 0, height = 0;
  int pixel_bits = 0;  ///< in the file
  int bits = 0;        ///< of a channel, as it is asked for
  int color = 0;       ///< PNG_COLOR_TYPE_*
  int passes = 1;
  bool srgb = false;   ///< the file says that it is
  bool icc = false;    ///< it has a profile
  bool rec709 = true;  ///< it does not name other primaries
  double gamma = 0.0;  ///< as it says; 0 if it does not
  std::size_t row_bytes = 0;
};

/// White, red, green and blue, as PNG's cHRM has them.
constexpr std::array rec709_xy{0.3127, 0.3290, 0.64, 0.33, 0.30, 0.60, 0.15, 0.06};

[[noreturn]] void png_fails(png_structp png, png_const_charp message) {
  auto* reading = static_cast<PngReading*>(png_get_error_ptr(png));
  std::strncpy(reading->error.data(), message, reading->error.size() - 1);
  png_longjmp(png, 1);
}

void png_warns(png_structp, png_const_charp) {
}

void png_reads(png_structp png, png_bytep into, std::size_t size) {
  auto* reading = static_cast<PngReading*>(png_get_io_ptr(png));
  if (size > reading->size - reading->position) {
    png_error(png, "it ends too early");
  }
  std::memcpy(into, reading->bytes + reading->position, size);
  reading->position += size;
}

/// The header, with samples asked for as 8 or 16 bits of gray or colour, with or without alpha.
/// False if libpng found an error.
bool read_png_header(png_structp png, png_infop info, PngReading& reading) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_read_info(png, info);
  reading.width = png_get_image_width(png, info);
  reading.height = png_get_image_height(png, info);
  reading.pixel_bits = png_get_bit_depth(png, info) * png_get_channels(png, info);
  int intent = 0;
  reading.srgb = png_get_sRGB(png, info, &intent) != 0;
  reading.icc = png_get_valid(png, info, PNG_INFO_iCCP) != 0;
  std::array<double, 8> xy = rec709_xy;
  png_get_cHRM(png, info, &xy[0], &xy[1], &xy[2], &xy[3], &xy[4], &xy[5], &xy[6], &xy[7]);
  reading.rec709 =
      std::ranges::equal(xy, rec709_xy, [](double a, double b) { return std::abs(a - b) < 2e-3; });
  if (png_get_gAMA(png, info, &reading.gamma) == 0) {
    reading.gamma = 0.0;
  }
  png_set_expand(png);  // palettes, fewer than 8 bits, and a transparent colour
  png_set_gray_to_rgb(png);
  reading.passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  reading.color = png_get_color_type(png, info);
  reading.bits = png_get_bit_depth(png, info);
  reading.row_bytes = png_get_rowbytes(png, info);
  return true;
}

bool read_png_row(png_structp png, png_bytep row, PngReading&) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_read_row(png, row, nullptr);
  return true;
}

bool read_png_end(png_structp png, PngReading&) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_read_end(png, nullptr);
  return true;
}

/// Throws where a chunk claims more than follows: libpng takes memory for it before it looks.
void check_png_chunks(const std::vector<std::uint8_t>& bytes) {
  constexpr std::size_t signature = 8;
  constexpr std::size_t around = 12;  // length, name and checksum
  for (std::size_t at = signature; at < bytes.size();) {
    const std::size_t left = bytes.size() - at;
    if (left < around) {
      throw std::runtime_error("it ends too early, within a chunk");
    }
    const std::size_t length = std::size_t(bytes[at]) << 24 | std::size_t(bytes[at + 1]) << 16 |
                               std::size_t(bytes[at + 2]) << 8 | bytes[at + 3];
    if (length > left - around) {
      throw std::runtime_error(
          fmt::format("it ends too early: a chunk at byte {} claims {} bytes, and {} follow", at,
                      length, left - around));
    }
    const bool last = std::memcmp(bytes.data() + at + 4, "IEND", 4) == 0;
    at = last ? bytes.size() : at + around + length;
  }
}

/// libpng's two structures.
class PngReader {
 public:
  explicit PngReader(PngReading& reading)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, png_fails, png_warns)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &reading, png_reads);
    // What a chunk is decompressed to, such as a colour profile, is small.
    constexpr std::size_t profile_bytes = std::size_t(1) << 20;
    png_set_chunk_malloc_max(png_, std::max(reading.size, profile_bytes));
    // Texts, of which there may be many, are not kept: 1 says none (0 any number).
    png_set_chunk_cache_max(png_, 1);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  png_structp png() const { return png_; }
  png_infop info() const { return info_; }

 private:
  png_structp png_;
  png_infop info_;
};

/// Linear light of each value of a channel.
struct PngTransfer {
  std::vector<float> linear;
  std::string note;
};

PngTransfer transfer_of(const PngReading& reading) {
  constexpr double srgb_gamma = 0.45455;  // what stands beside sRGB for readers who know no better
  const bool power =
      !reading.srgb && reading.gamma > 0.0 && std::abs(reading.gamma - srgb_gamma) > 1e-3;
  if (power && (reading.gamma < 0.1 || reading.gamma > 10.0)) {
    throw std::runtime_error(
        fmt::format("its gamma is {}; from 0.1 to 10 would be right", reading.gamma));
  }
  PngTransfer transfer;
  const std::size_t count = std::size_t(1) << reading.bits;
  transfer.linear.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double encoded = double(i) / double(count - 1);
    transfer.linear[i] =
        float(power ? std::pow(encoded, 1.0 / reading.gamma) : srgb_decode(encoded));
  }
  const bool linear = power && std::abs(reading.gamma - 1.0) < 1e-3;
  transfer.note =
      linear ? fmt::format("its {} bits from black to white are linear by its gamma", reading.bits)
             : fmt::format("it is display-referred, {} bits from black to white: decoded {}",
                           reading.bits,
                           power ? fmt::format("by its gamma {:.4g}", reading.gamma) : "from sRGB");
  if (reading.icc && !reading.srgb) {
    transfer.note += ", without its colour profile";
  }
  return transfer;
}

std::uint32_t png_sample(const std::uint8_t* row, std::size_t index, int bits) {
  return bits == 16 ? std::uint32_t(row[2 * index]) << 8 | row[2 * index + 1] : row[index];
}

/// Straight alpha: the colour counts as much as it covers. Returns whether any is not opaque.
bool set_png_row(const std::uint8_t* row, const PngReading& reading, const PngTransfer& transfer,
                 int y, RadianceImage& image) {
  const bool has_alpha = (reading.color & PNG_COLOR_MASK_ALPHA) != 0;
  const std::size_t channels = has_alpha ? 4 : 3;
  const std::uint32_t opaque = (1u << reading.bits) - 1;
  bool transparent = false;
  for (int x = 0; x < image.width(); ++x) {
    const std::size_t first = channels * std::size_t(x);
    glm::vec3 color;
    for (int c = 0; c < 3; ++c) {
      color[c] = transfer.linear[png_sample(row, first + std::size_t(c), reading.bits)];
    }
    const std::uint32_t alpha = has_alpha ? png_sample(row, first + 3, reading.bits) : opaque;
    transparent = transparent || alpha != opaque;
    image.at(x, y) = color * (float(alpha) / float(opaque));
  }
  return transparent;
}

}  // namespace

Picture read_png_picture(FileReader& file, const std::stop_token& stop) {
  constexpr std::uint64_t longest = std::uint64_t(1) << 31;
  if (file.size() > longest) {
    throw std::runtime_error(
        fmt::format("it has {} bytes; up to {} would be right", file.size(), longest));
  }
  std::vector<std::uint8_t> bytes(std::size_t(file.left()));
  file.read(bytes.data(), bytes.size());
  check_png_chunks(bytes);
  PngReading reading;
  reading.bytes = bytes.data();
  reading.size = bytes.size();
  const PngReader reader(reading);
  const auto check = [&](bool done) {
    if (!done) {
      throw std::runtime_error(reading.error.data());
    }
  };
  check(read_png_header(reader.png(), reader.info(), reading));
  // Deflate makes up to 1032 bytes of one.
  check_claimed_size(reading.width, reading.height, 1032.0 * 8.0 / reading.pixel_bits,
                     bytes.size());
  Picture picture = whole_picture(reading.width, reading.height);
  const PngTransfer transfer = transfer_of(reading);
  // An interlaced picture comes in passes, which fill what those before have left open.
  const std::size_t kept = reading.passes > 1 ? reading.height : 1;
  std::vector<std::uint8_t> rows(kept * reading.row_bytes);
  bool transparent = false;
  for (int pass = 0; pass < reading.passes; ++pass) {
    for (int y = 0; y < picture.height; ++y) {
      check_cancelled(stop);
      std::uint8_t* row = rows.data() + (kept > 1 ? std::size_t(y) * reading.row_bytes : 0);
      check(read_png_row(reader.png(), row, reading));
      if (pass + 1 == reading.passes) {
        transparent = set_png_row(row, reading, transfer, y, picture.image) || transparent;
      }
    }
  }
  check(read_png_end(reader.png(), reading));
  picture.notes.push_back(transfer.note);
  if (!reading.rec709 && !reading.srgb) {
    picture.notes.emplace_back(
        "its primaries are not those of Rec. 709; its numbers are taken as they are");
  }
  if (transparent) {
    picture.notes.emplace_back("its colours are multiplied by its alpha: what they add to black");
  }
  return picture;
}

}  // namespace quartet
