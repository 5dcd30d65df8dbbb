#pragma once

#include <glm/glm.hpp>

namespace quartet {

/// A colour slot of a material or an emitter: one value, or a texture of the scene.
struct Color {
  static constexpr int no_texture = -1;
  glm::vec3 value{0.0f};
  int texture = no_texture;  ///< index into Scene::textures; `value` is not used then

  bool is_textured() const { return texture != no_texture; }
};

}  // namespace quartet
