#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/file_reader.h"
#include "renderer/files/exr.h"

namespace quartet {

/// What EXR files may be at most, for those that are written and those that are read: larger than
/// any picture of ours, and small enough that a damaged header cannot ask for all memory.
inline constexpr int max_exr_side = 1 << 16;
inline constexpr std::size_t max_exr_numbers = std::size_t(1) << 28;  // 1 GB

/// What is compressed at once, and how far at most.
struct ExrCompressionLimits {
  std::int64_t lines;     ///< of a scanline file
  std::uint64_t expands;  ///< bytes of pixels that a byte of the file can become
};

struct ExrTiles {
  std::uint32_t width = 0, height = 0;
};

/// What a part's header says of its size.
struct ExrPart {
  std::int64_t left = 0, top = 0, width = 0, height = 0;
  std::uint64_t channels = 0;
  std::uint64_t pixel_bytes = 0;  ///< of all channels of a pixel
  ExrCompressionLimits compression{1, 1};
  std::optional<ExrTiles> tiles;
  std::uint64_t chunks = 0;  ///< as it is given; 0 if it is not
  bool deep = false;         ///< any number of values a pixel
  bool empty = true;         ///< no attribute at all: the end of the headers
};

struct ExrSizes {
  std::vector<ExrPart> parts;  ///< none of what is no EXR at all
  std::uint64_t bytes = 0;     ///< that follow the headers
  std::uint64_t block = 0;     ///< bytes of the largest block, which is decompressed at once
};

/// Looks at the headers of a file before OpenEXR does, which takes whatever memory they ask for:
/// no attribute may claim more bytes than follow, no table more entries than could. Throws
/// std::runtime_error that says what is wrong. What is no EXR at all, and all else, is left for
/// OpenEXR to judge.
ExrSizes check_exr_headers(FileReader& file);

/// The same before so many channels of one part are read: it may have no more pixels than its
/// compression could get into the file, and no deep ones.
void check_exr_part(const ExrSizes& sizes, std::size_t part, std::size_t channels);

/// "640x480 at (0, 0)".
std::string text_of(const ExrWindow& window);

/// One line, whatever a library's message looks like.
std::string one_line(std::string text);

/// Threads of OpenEXR's own that compress and decompress; they start with the first file.
int exr_threads();

}  // namespace quartet
