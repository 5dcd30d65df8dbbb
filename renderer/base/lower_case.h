#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace quartet {

/// With small letters for the large ones of ASCII.
inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

}  // namespace quartet
