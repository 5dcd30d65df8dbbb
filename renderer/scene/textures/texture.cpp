#include "renderer/scene/textures/texture.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/base/number_text.h"

namespace quartet {

glm::vec3 average_color(const Textures& textures, const Color& color) {
  return color.is_textured() ? std::visit([](const auto& kind) { return kind.mean(); },
                                          textures[std::size_t(color.texture)])
                             : color.value;
}

float largest_value(const Textures& textures, const Color& color) {
  const auto largest = [](const glm::vec3& value) { return std::max({value.x, value.y, value.z}); };
  if (!color.is_textured()) return largest(color.value);
  float most = 0.0f;
  const auto look = [&](const auto& kind) {
    for (const glm::vec3& value : kind.extremes()) most = std::max(most, largest(value));
  };
  std::visit(look, textures[std::size_t(color.texture)]);
  return most;
}

std::string color_text(const Textures& textures, const Color& color) {
  std::string mean = vector_text(average_color(textures, color));
  if (!color.is_textured()) return mean;
  return fmt::format("{}, {} on average",
                     std::visit([](const auto& kind) { return kind.text(); },
                                textures[std::size_t(color.texture)]),
                     mean);
}

}  // namespace quartet
