#include "renderer/base/number_text.h"

#include <fmt/format.h>

#include <cmath>

namespace quartet {

std::string format_number(double value) {
  std::string text = fmt::format("{:.4g}", value == 0.0 ? 0.0 : value);
  if (const std::size_t exponent = text.find('e'); exponent != std::string::npos) {
    const int power = std::stoi(text.substr(exponent + 1));
    text = fmt::format("{}e{}", text.substr(0, exponent), power);
  }
  return text;
}

std::string short_number(float value) {
  const float size = std::abs(value);
  if (!std::isfinite(value)) {
    return fmt::format("{}", value);
  }
  if (size == 0.0f) {
    return "0";
  }
  if (size < 0.001f || size >= 10000.0f) {
    return fmt::format("{:.1e}", value);
  }
  return size < 1.0f     ? fmt::format("{:.{}f}", value, size < 0.01f ? 4 : 3)
         : size < 10.0f  ? fmt::format("{:.2f}", value)
         : size < 100.0f ? fmt::format("{:.1f}", value)
                         : fmt::format("{:.0f}", value);
}

std::string vector_text(glm::vec3 v) {
  return v.x == v.y && v.y == v.z ? fmt::format("{:.4g}", v.x)
                                  : fmt::format("{:.4g} {:.4g} {:.4g}", v.x, v.y, v.z);
}

}  // namespace quartet
