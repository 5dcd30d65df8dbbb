#include <utility>

#include "renderer/scene/shapes/shape_rows.h"
#include "renderer/scene/xml/element.h"

namespace quartet {
namespace {

/// [-1, 1]² at z = 0 with normal +z and uv [0, 1]².
Mesh make_rectangle(const glm::dmat4& to_world, bool flip_normals) {
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const bool mirrored = glm::determinant(glm::dmat3(to_world)) < 0.0;
  if (mirrored != flip_normals) {
    // Exchanging the two edges turns the front around and keeps the order of a parallelogram.
    std::swap(mesh.positions[1], mesh.positions[3]);
    std::swap(mesh.uvs[1], mesh.uvs[3]);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parallelogram = true;
  transform(mesh, to_world);
  return mesh;
}

Geometry read_rectangle(SceneBuilder& /*builder*/, Element& element) {
  return make_rectangle(element.transform("to_world"), element.boolean("flip_normals", false));
}

}  // namespace

constexpr ShapeRow rectangle_row{"rectangle", read_rectangle};

}  // namespace quartet
