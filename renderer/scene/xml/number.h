#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quartet {

/// The parts of `text` between commas and white space.
std::vector<std::string_view> split(std::string_view text);

/// All of `text` as one finite decimal number, whatever the locale; nothing if it is anything else.
std::optional<double> parse_number(std::string_view text);
/// The same, if single precision can hold it.
std::optional<float> parse_float(std::string_view text);

/// The shortest decimal number that parse_float() reads as `value`, which is finite.
std::string exact_text(float value);

}  // namespace quartet
