#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/scene.h"

namespace quartet {

inline glm::vec3 color_at(const Checkerboard& texture, glm::vec2 uv) {
  const glm::vec3 p = texture.to_uv * glm::vec3(uv, 1.0f);
  const bool right = p.x - glm::floor(p.x) >= 0.5f;
  const bool upper = p.y - glm::floor(p.y) >= 0.5f;
  return right == upper ? texture.color0 : texture.color1;
}

/// The colour of a slot at a surface point with texture coordinates `uv`.
inline glm::vec3 color_at(const Scene& scene, const Color& color, glm::vec2 uv) {
  return color.texture == Color::no_texture
             ? color.value
             : color_at(scene.textures[std::size_t(color.texture)], uv);
}

/// The mean of a slot over the plane.
inline glm::vec3 average_color(const Scene& scene, const Color& color) {
  if (color.texture == Color::no_texture) {
    return color.value;
  }
  const Checkerboard& texture = scene.textures[std::size_t(color.texture)];
  return 0.5f * (texture.color0 + texture.color1);
}

}  // namespace quartet
