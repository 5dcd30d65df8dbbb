#include "renderer/base/number_text.h"

#include <fmt/format.h>

namespace quartet {

std::string format_number(double value) {
  std::string text = fmt::format("{:.4g}", value == 0.0 ? 0.0 : value);
  if (const std::size_t exponent = text.find('e'); exponent != std::string::npos) {
    const int power = std::stoi(text.substr(exponent + 1));
    text = fmt::format("{}e{}", text.substr(0, exponent), power);
  }
  return text;
}

}  // namespace quartet
