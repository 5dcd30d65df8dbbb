#include <array>

#include "renderer/scene/shapes/shape_rows.h"
#include "renderer/scene/xml/element.h"

namespace quartet {
namespace {

/// [-1, 1]³, each face with uv [0, 1]².
Mesh make_cube(const glm::dmat4& to_world, bool face_normals, bool flip_normals) {
  // One row a face: the corner with uv (0, 0), the directions of u and of v; v × u points outward.
  struct Face {
    glm::vec3 corner, u, v;
  };
  constexpr std::array faces = {
      Face{{-1, -1, -1}, {0, 0, 2}, {2, 0, 0}}, Face{{1, 1, 1}, {-2, 0, 0}, {0, 0, -2}},
      Face{{1, -1, 1}, {0, 2, 0}, {0, 0, -2}},  Face{{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}},
      Face{{-1, -1, -1}, {0, 2, 0}, {0, 0, 2}}, Face{{-1, 1, -1}, {0, -2, 0}, {2, 0, 0}},
  };
  Mesh mesh;
  for (const Face& face : faces) {
    const unsigned first = unsigned(mesh.positions.size());
    for (const glm::vec2 uv :
         {glm::vec2(0, 0), glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0)}) {
      mesh.positions.push_back(face.corner + uv.x * face.u + uv.y * face.v);
      mesh.normals.push_back(glm::normalize(glm::cross(face.v, face.u)));
      mesh.uvs.push_back(uv);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  }
  transform(mesh, to_world);
  // As in Mitsuba, only the vertex normals know that a mirrored cube still faces outward.
  if (!face_normals) orient_by_normals(mesh);
  mesh.normals.clear();
  if (flip_normals) flip(mesh);
  return mesh;
}

Geometry read_cube(SceneBuilder& /*builder*/, Element& element) {
  return make_cube(element.transform("to_world"), element.boolean("face_normals", false),
                   element.boolean("flip_normals", false));
}

}  // namespace

constexpr ShapeRow cube_row{"cube", read_cube};

}  // namespace quartet
