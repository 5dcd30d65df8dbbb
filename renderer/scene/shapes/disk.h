#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "renderer/scene/shapes/box.h"

namespace quartet {

class ElementWriter;
class Hasher;

struct Disk {
  static constexpr std::string_view name = "disk";

  glm::vec3 center{0.0f};
  glm::vec3 normal{0.0f, 0.0f, 1.0f};  ///< unit length, the front
  glm::vec3 axis_u{1.0f, 0.0f, 0.0f};  ///< unit length, where the angle of uv is 0
  glm::vec3 axis_v{0.0f, 1.0f, 0.0f};  ///< unit length, where it is 1/4; left-handed if mirrored
  float radius = 1.0f;

  Box box() const;
  double area() const;
  std::size_t pieces() const { return 1; }
  std::string text() const { return std::string(name); }
  void add_to(Hasher& hasher) const;
  void write(ElementWriter& element) const;
};

}  // namespace quartet
