#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "renderer/base/printable.h"

namespace quartet {

/// The word as bash and POSIX 2024 read it, $'...', with escapes for what is no text.
inline std::string escaped_shell_word(std::string_view word) {
  std::string text = "$'";
  while (!word.empty()) {
    const std::size_t length = utf8_length(word);
    const char first = word.front();
    if (length == 0 || printable(word.substr(0, length)) != word.substr(0, length)) {
      for (const char c : word.substr(0, std::max<std::size_t>(length, 1))) {
        text += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
      }
    } else {
      text += first == '\'' || first == '\\' ? "\\" : "";
      text += word.substr(0, length);
    }
    word.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text + "'";
}

/// A word as a shell would have to read it; always UTF-8 and one line.
inline std::string shell_word(std::string_view word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string_view::npos) {
    return std::string(word);
  }
  if (printable(word) != word) {
    return escaped_shell_word(word);
  }
  std::string text = "'";
  for (const char c : word) {
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return text + "'";
}

}  // namespace quartet
