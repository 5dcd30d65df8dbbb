#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "renderer/base/file_reader.h"
#include "renderer/files/exr.h"

namespace quartet {

/// What EXR files may be at most, for those that are written and those that are read: larger than
/// any picture of ours, and small enough that a damaged header cannot ask for all memory.
inline constexpr int max_exr_side = 1 << 16;
inline constexpr std::size_t max_exr_numbers = std::size_t(1) << 28;  // 1 GB

/// Looks at the headers of a file before OpenEXR does, which takes whatever memory they ask for:
/// no attribute may claim more bytes than follow, no picture more pixels than its compression could
/// get into the file, no table more entries. Returns the bytes of a block of the first part, which
/// is what OpenEXR decompresses at once. Throws std::runtime_error that says what is wrong. What is
/// no EXR at all, and all else, is left for OpenEXR to judge.
std::uint64_t check_exr_headers(FileReader& file);

/// "640x480 at (0, 0)".
std::string text_of(const ExrWindow& window);

/// One line, whatever a library's message looks like.
std::string one_line(std::string text);

/// Threads of OpenEXR's own that compress and decompress; they start with the first file.
int exr_threads();

}  // namespace quartet
