#include "renderer/scene/xml/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace quartet {

std::vector<std::string_view> split(std::string_view text) {
  constexpr std::string_view separators = ", \t\r\n";
  std::vector<std::string_view> parts;
  std::size_t begin = text.find_first_not_of(separators);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(separators, end);
  }
  return parts;
}

std::optional<double> parse_number(std::string_view text) {
  // std::from_chars, because strtod and streams read "1.5" as 1 in some locales.
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<float> parse_float(std::string_view text) {
  const std::optional<double> value = parse_number(text);
  if (!value || std::abs(*value) > std::numeric_limits<float>::max()) return std::nullopt;
  return float(*value);
}

std::string exact_text(float value) {
  // Shortest of all that are nearer to it than to another float; but what stands half-way between
  // two of them in double precision is read as the other one.
  std::string text = fmt::format("{}", value);
  return parse_float(text) == value ? text : fmt::format("{}", double(value));
}

}  // namespace quartet
