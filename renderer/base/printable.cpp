#include "renderer/base/printable.h"

#include <fmt/format.h>

#include <array>
#include <iterator>

namespace quartet {
namespace {

/// How a character begins: its bytes, the bits of it that the first one holds, and the least
/// character that is written in so many bytes.
struct Utf8Lead {
  unsigned char mask, bits;
  std::size_t length;
  char32_t least;
};

constexpr std::array<Utf8Lead, 4> utf8_leads{
    {{0x80, 0x00, 1, 0}, {0xe0, 0xc0, 2, 0x80}, {0xf0, 0xe0, 3, 0x800}, {0xf8, 0xf0, 4, 0x10000}}};

struct Utf8Character {
  char32_t code = 0;
  std::size_t length = 0;  ///< in bytes; 0: no character
};

Utf8Character first_character(std::string_view text) {
  if (text.empty()) {
    return {};
  }
  const auto first = static_cast<unsigned char>(text.front());
  for (const Utf8Lead& lead : utf8_leads) {
    if ((first & lead.mask) != lead.bits) {
      continue;
    }
    if (text.size() < lead.length) {
      return {};
    }
    char32_t code = first & static_cast<unsigned char>(~lead.mask);
    for (const char next : text.substr(1, lead.length - 1)) {
      const auto byte = static_cast<unsigned char>(next);
      if ((byte & 0xc0) != 0x80) {
        return {};
      }
      code = code << 6 | (byte & 0x3f);
    }
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    return code < lead.least || code > 0x10ffff || surrogate ? Utf8Character{}
                                                             : Utf8Character{code, lead.length};
  }
  return {};
}

bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

bool turns_direction(char32_t code) {
  return (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  return first_character(text).length;
}

std::string printable(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  const auto out = std::back_inserter(shown);
  while (!text.empty()) {
    const auto [code, length] = first_character(text);
    if (length == 0) {
      fmt::format_to(out, "\\x{:02x}", static_cast<unsigned char>(text.front()));
    } else if (code == '\n' || code == '\t') {
      shown += code == '\n' ? "\\n" : "\\t";
    } else if (is_control(code)) {
      fmt::format_to(out, "\\x{:02x}", unsigned(code));
    } else if (turns_direction(code)) {
      fmt::format_to(out, "\\u{:04x}", unsigned(code));
    } else {
      shown += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return shown;
}

}  // namespace quartet
