#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "renderer/scene/shapes/box.h"

namespace quartet {

class ElementWriter;
class Hasher;

struct Sphere {
  static constexpr std::string_view name = "sphere";

  glm::vec3 center{0.0f};
  float radius = 1.0f;
  bool flip_normals = false;  ///< the front is the inside
  glm::mat3 to_local{1.0f};   ///< world direction to the sphere's own axes, for uv

  Box box() const { return {center - radius, center + radius}; }
  double area() const;
  std::size_t pieces() const { return 1; }
  std::string text() const { return std::string(name); }
  void add_to(Hasher& hasher) const;
  void write(ElementWriter& element) const;
};

}  // namespace quartet
