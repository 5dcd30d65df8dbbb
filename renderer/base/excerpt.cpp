#include "renderer/base/excerpt.h"

#include <fmt/format.h>

#include "renderer/base/printable.h"

namespace quartet {

std::string excerpt(std::string_view text, std::size_t most) {
  if (text.size() <= most) {
    return printable(text);
  }
  // Not in the middle of a character: all but its first byte begin with the bits 10.
  std::size_t end = most;
  while (end > 0 && most - end < 3 && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u) {
    --end;
  }
  return fmt::format("{}... ({} bytes more)", printable(text.substr(0, end)), text.size() - end);
}

}  // namespace quartet
