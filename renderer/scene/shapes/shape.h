#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "renderer/scene/color.h"
#include "renderer/scene/mesh/mesh.h"
#include "renderer/scene/shapes/disk.h"
#include "renderer/scene/shapes/sphere.h"

namespace quartet {

/// The kinds of geometry, one file each. A kind says what it is called (name), what it is to people
/// (text), the box around it (box), its area in world units² (area), how many pieces it has, of
/// which a ray meets one and each of which is a light if it shines (pieces), and how it is hashed
/// (add_to) and written (write).
using Geometry = std::variant<Mesh, Sphere, Disk>;

struct Shape {
  Geometry geometry;
  int material = 0;  ///< index into Scene::materials
  bool emits = false;
  Color radiance;  ///< of the front side, where `emits`
  std::string id;  ///< as in the file, may be empty
  int line = 0;    ///< in the scene file, for messages

  void add_to(Hasher& hasher) const;
};

/// Total area of a shape.
double surface_area(const Shape& shape);

/// What its geometry is called.
std::string_view shape_name(const Shape& shape);

/// "sphere", "mesh of 12 triangles".
std::string shape_text(const Shape& shape);

}  // namespace quartet
