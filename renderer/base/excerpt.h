#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace quartet {

/// What a file says, for a message: printable, and cut after about `most` bytes, with how many were
/// left out: "abc... (997 bytes more)".
std::string excerpt(std::string_view text, std::size_t most = 80);

/// Names for a message, at most 20 of them: "a, b and 998 more"; `none` if there are none.
template <class Names>
std::string name_list(const Names& names, std::string_view none) {
  constexpr std::size_t most = 20;
  std::string list;
  std::size_t count = 0;
  for (const auto& name : names) {
    if (count < most) {
      list += (count > 0 ? ", " : "") + excerpt(name);
    }
    ++count;
  }
  if (count > most) {
    list += " and " + std::to_string(count - most) + " more";
  }
  return count > 0 ? list : std::string(none);
}

}  // namespace quartet
