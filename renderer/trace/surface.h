#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "renderer/scene/scene.h"
#include "renderer/trace/accel.h"

namespace quartet {

/// Where a ray meets a shape.
struct Surface {
  glm::vec3 position;
  glm::vec3 normal;          ///< geometric, unit length, on the front side of the shape
  glm::vec3 shading_normal;  ///< interpolated where the mesh has normals; same side as `normal`
  glm::vec2 uv;              ///< (0, 0) where no texture of the shape asks for it
  std::uint32_t shape;
  std::uint32_t primitive;
};

/// Texture coordinates of a point on a shape; `hit` gives triangle and barycentrics of a mesh.
glm::vec2 uv_at(const Shape& shape, glm::vec3 position, const Hit& hit);

/// Whether any texture of the shape asks for uv.
bool needs_uv(const Scene& scene, const Shape& shape);

Surface surface_at(const Shape& shape, bool with_uv, const Ray& ray, const Hit& hit);

/// A ray origin on the side of the surface that `direction` points to, moved off by a few times the
/// rounding error of a hit: that error grows with the coordinates, so the offset does.
inline glm::vec3 offset_origin(const Surface& surface, glm::vec3 direction) {
  const glm::vec3 p = glm::abs(surface.position);
  const float scale = 0x1p-17f * std::max({p.x, p.y, p.z, 0x1p-10f});
  return surface.position +
         surface.normal * (glm::dot(direction, surface.normal) >= 0.0f ? scale : -scale);
}

}  // namespace quartet
