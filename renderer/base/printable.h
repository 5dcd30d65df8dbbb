#pragma once

#include <string>
#include <string_view>

namespace quartet {

/// Text that came from a file, a path or a library, as it may be shown on a terminal or in a
/// window: control characters as \n, \t or \xNN, bytes that are no UTF-8 as \xNN, and the marks
/// that turn the direction of writing as \u202e and the like. All else stays as it is, backslashes
/// too: this is for readers and is not read back.
std::string printable(std::string_view text);

/// Bytes at the beginning of `text` that are one character of UTF-8; 0 if none is, or none is left.
std::size_t utf8_length(std::string_view text);

}  // namespace quartet
