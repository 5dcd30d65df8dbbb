#pragma once

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
  float offset;              ///< along the normal, beyond all rounding errors of the position
  std::uint32_t shape;
  std::uint32_t primitive;
};

/// Texture coordinates of a point on a shape; `hit` gives triangle and barycentrics of a mesh.
glm::vec2 uv_at(const Shape& shape, glm::vec3 position, const Hit& hit);

/// Whether any texture of the shape asks for uv.
bool needs_uv(const Scene& scene, const Shape& shape);

Surface surface_at(const Shape& shape, bool with_uv, const Ray& ray, const Hit& hit);

/// A ray origin on the side of the surface that `direction` points to.
inline glm::vec3 offset_origin(const Surface& surface, glm::vec3 direction) {
  const bool front = glm::dot(direction, surface.normal) >= 0.0f;
  return surface.position + surface.normal * (front ? surface.offset : -surface.offset);
}

}  // namespace quartet
