#include "renderer/files/exr_header.h"

#include <ImfThreading.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace quartet {
namespace {

// In the order of the numbers in the file: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
// Deflate makes up to 1032 bytes of one, PXR24 a third more by leaving bits out; RLE 128 of two;
// PIZ's run lengths 512 of less than three; B44A 32 of three. DWA's flat blocks of 64 pixels take
// a few bytes which are deflated in turn. Rounded up.
constexpr std::array<ExrCompressionLimits, 10> compression_limits{{{1, 1},
                                                                   {1, 128},
                                                                   {1, 1100},
                                                                   {16, 1100},
                                                                   {32, 1100},
                                                                   {16, 1500},
                                                                   {32, 16},
                                                                   {32, 16},
                                                                   {32, 150'000},
                                                                   {256, 150'000}}};
constexpr ExrCompressionLimits unknown_compression{1, 150'000};

// OpenEXR keeps several whole tiles in memory, however small the picture is.
constexpr std::uint64_t max_tile_bytes = std::uint64_t(1) << 28;

[[noreturn]] void refuse_header(const std::string& reason) {
  throw std::runtime_error(reason);
}

/// The words of a header, which are little-endian like this machine.
template <class T>
T read_word(FileReader& file) {
  T value{};
  file.read(&value, sizeof(value));
  return value;
}

/// A text that ends with a 0, which is not part of it.
std::string read_name(FileReader& file) {
  constexpr std::size_t longest = 255;
  std::string name;
  for (char c = read_word<char>(file); c != '\0'; c = read_word<char>(file)) {
    if (name.size() == longest) {
      refuse_header(fmt::format("a name in its header has more than {} bytes", longest));
    }
    name += c;
  }
  return name;
}

/// Values that OpenEXR reads as so many bytes, whatever the header says: a header that says
/// otherwise would be another one to OpenEXR than it is here.
struct FixedSize {
  std::string_view type;
  std::int32_t bytes;
};

constexpr std::array<FixedSize, 24> fixed_sizes{{
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
}};

void check_size(FileReader& file, std::string_view name, std::string_view type, std::int32_t size) {
  if (size < 0 || std::uint64_t(size) > file.left()) {
    refuse_header(fmt::format("attribute '{}' in its header claims {} bytes, and {} follow", name,
                              size, file.left()));
  }
  const auto* const fixed = std::ranges::find(fixed_sizes, type, &FixedSize::type);
  const std::int32_t right = fixed != fixed_sizes.end() ? fixed->bytes
                             : type == "floatvector"    ? size / 4 * 4
                                                        : size;
  if (size != right) {
    refuse_header(
        fmt::format("attribute '{}' in its header has {} bytes; {} would be right for a "
                    "{}",
                    name, size, right, type));
  }
}

/// Texts with their lengths, which must end where the attribute does.
void check_texts(FileReader& file, std::string_view name, std::uint64_t end) {
  while (file.position() < end) {
    const auto length = read_word<std::int32_t>(file);
    if (length < 0 || std::uint64_t(length) > end - std::min(end, file.position())) {
      refuse_header(
          fmt::format("attribute '{}' in its header holds a text of {} bytes", name, length));
    }
    file.seek(file.position() + std::uint64_t(length));
  }
}

void read_channels(FileReader& file, std::uint64_t end, ExrPart& part) {
  // To the empty name, which is where OpenEXR ends as well.
  while (!read_name(file).empty()) {
    const auto type = read_word<std::int32_t>(file);
    ++part.channels;
    part.pixel_bytes += type == 1 ? 2 : 4;  // half, else float or uint
    file.seek(file.position() + 12);        // how it is seen, and sampling
  }
  if (file.position() != end) {
    refuse_header("a list of channels in its header does not end where it should");
  }
}

void read_value(FileReader& file, std::string_view name, std::uint64_t end, ExrPart& part) {
  if (name == "compression") {
    const auto kind = read_word<std::uint8_t>(file);
    part.compression =
        kind < compression_limits.size() ? compression_limits.at(kind) : unknown_compression;
  } else if (name == "dataWindow") {
    std::array<std::int32_t, 4> box{};
    file.read(box.data(), sizeof(box));
    part.left = box[0];
    part.top = box[1];
    part.width = std::int64_t(box[2]) - box[0] + 1;
    part.height = std::int64_t(box[3]) - box[1] + 1;
  } else if (name == "tiles") {
    part.tiles.emplace();
    part.tiles->width = read_word<std::uint32_t>(file);
    part.tiles->height = read_word<std::uint32_t>(file);
  } else if (name == "type") {
    std::string kind(std::size_t(end - file.position()), '\0');
    file.read(kind.data(), kind.size());
    part.deep = kind.starts_with("deep");
  } else if (name == "chunkCount") {
    part.chunks = std::uint64_t(std::max(0, read_word<std::int32_t>(file)));
  }
}

ExrPart read_part(FileReader& file) {
  ExrPart part;
  for (std::string name = read_name(file); !name.empty(); name = read_name(file)) {
    part.empty = false;
    const std::string type = read_name(file);
    const auto size = read_word<std::int32_t>(file);
    check_size(file, name, type, size);
    const std::uint64_t begin = file.position();
    const std::uint64_t end = begin + std::uint64_t(size);
    // By their types, whatever their names: OpenEXR reads them to their own ends.
    if (type == "stringvector") {
      check_texts(file, name, end);
    } else if (type == "chlist") {
      read_channels(file, end, part);
    }
    file.seek(begin);
    read_value(file, name, end, part);
    file.seek(end);
  }
  return part;
}

std::uint64_t divided_up(std::int64_t all, std::uint64_t each) {
  return (std::uint64_t(all) + each - 1) / std::max<std::uint64_t>(each, 1);
}

/// Entries of the table that says where each piece of the part begins, those of smaller levels
/// left out.
std::uint64_t pieces(const ExrPart& part) {
  const std::uint64_t counted =
      part.tiles
          ? divided_up(part.width, part.tiles->width) * divided_up(part.height, part.tiles->height)
          : divided_up(part.height, std::uint64_t(part.compression.lines));
  return std::max(counted, part.chunks);
}

std::uint64_t block_bytes(const ExrPart& part) {
  return part.tiles ? part.pixel_bytes * part.tiles->width * part.tiles->height
                    : part.pixel_bytes * std::uint64_t(part.width * part.compression.lines);
}

/// Sizes that OpenEXR itself refuses are left to it.
bool is_sane(const ExrPart& part) {
  return part.width > 0 && part.height > 0 && part.width <= max_exr_side &&
         part.height <= max_exr_side &&
         (!part.tiles || (part.tiles->width > 0 && part.tiles->height > 0));
}

bool has_huge_tiles(const ExrPart& part) {
  return part.tiles && (part.tiles->width > max_exr_side || part.tiles->height > max_exr_side);
}

void check_pixels(const ExrPart& part, std::uint64_t channels, std::uint64_t bytes) {
  const std::uint64_t pixels = std::uint64_t(part.width) * std::uint64_t(part.height);
  const ExrWindow window{int(part.left), int(part.top), int(part.width), int(part.height)};
  if (channels > max_exr_numbers / pixels) {
    refuse_header(
        fmt::format("{} pixels with {} channels would take {} MB; at most {} MB would be right",
                    text_of(window), channels, (channels * pixels) >> 18, max_exr_numbers >> 18));
  }
  if (part.pixel_bytes * pixels / part.compression.expands > bytes) {
    refuse_header(fmt::format(
        "its header claims {} pixels with {} channels, {} bytes, which do not fit the {} bytes "
        "that follow, however they are compressed; it is cut or damaged",
        text_of(window), part.channels, part.pixel_bytes * pixels, bytes));
  }
  if (part.tiles) {
    const auto [width, height] = *part.tiles;
    if (has_huge_tiles(part) || block_bytes(part) > max_tile_bytes) {
      refuse_header(fmt::format("tiles of {}x{} pixels are too large; up to {} MB would be right",
                                width, height, max_tile_bytes >> 20));
    }
  }
}

}  // namespace

ExrSizes check_exr_headers(FileReader& file) {
  constexpr std::uint32_t exr_magic = 20000630;
  constexpr std::uint32_t multi_part = 0x1000;
  ExrSizes sizes;
  file.seek(0);
  if (file.size() < 8 || read_word<std::uint32_t>(file) != exr_magic) {
    return sizes;
  }
  const bool several = (read_word<std::uint32_t>(file) & multi_part) != 0;
  std::uint64_t table = 0;
  for (bool more = true; more;) {
    const ExrPart part = read_part(file);
    more = several && !part.empty;
    if (!more && several) {
      break;
    }
    table += is_sane(part) ? pieces(part) : part.chunks;
    if (is_sane(part) && !has_huge_tiles(part)) {
      sizes.block = std::max(sizes.block, block_bytes(part));
    }
    sizes.parts.push_back(part);
  }
  sizes.bytes = file.left();
  constexpr std::uint64_t entry = 8;  // bytes
  if (table > sizes.bytes / entry) {
    refuse_header(
        fmt::format("its header claims {} blocks or tiles, and {} bytes follow; it is cut or "
                    "damaged",
                    table, sizes.bytes));
  }
  return sizes;
}

void check_exr_part(const ExrSizes& sizes, std::size_t part, std::size_t channels) {
  if (part >= sizes.parts.size()) {
    return;
  }
  const ExrPart& chosen = sizes.parts[part];
  if (chosen.deep) {
    refuse_header("its pixels are deep; one value a channel and pixel would be right");
  }
  if (is_sane(chosen)) {
    check_pixels(chosen, channels, sizes.bytes);
  }
}

std::string text_of(const ExrWindow& window) {
  return fmt::format("{}x{} at ({}, {})", window.width, window.height, window.x, window.y);
}

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

int exr_threads() {
  static const int count = [] {
    Imf::setGlobalThreadCount(tbb::this_task_arena::max_concurrency());
    return Imf::globalThreadCount();
  }();
  return count;
}

}  // namespace quartet
