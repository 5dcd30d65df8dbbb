#pragma once

#include <string>
#include <string_view>

namespace quartet {

/// A text as one field of a CSV file, RFC 4180: in quotes where it would else end the field or the
/// row. Every text that is not one of Quartet's own ids goes through here.
inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    return std::string(text);
  }
  std::string field = "\"";
  for (const char c : text) {
    field += c == '"' ? std::string("\"\"") : std::string(1, c);
  }
  return field + "\"";
}

}  // namespace quartet
