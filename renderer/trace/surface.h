#pragma once

#include <glm/glm.hpp>
#include <stop_token>
#include <vector>

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

/// Where eight rays do. `normal` and `shading_normal` as above.
struct Surface8 {
  Vec8 position;
  Vec8 normal;
  Vec8 shading_normal;
  Float8 offset;
};

/// What tracing wants to know of a triangle, worked out once and in one cache line; of one, or of
/// eight.
template <class F>
struct alignas(64) FacetOf {
  Vec3<F> corner, edge1, edge2;
  Vec3<F> normal;  ///< unit length
  F offset;
  Vec3<F> reflectance{};  ///< of its material, where that has one everywhere
};
using Facet = FacetOf<float>;
using Facet8 = FacetOf<Float8>;

/// Throws Cancelled soon after `stop` was asked for.
std::vector<Facet> facets_of(const Mesh& mesh, const std::stop_token& stop = {});

/// The unit normal of the plane of two edges, also where they are so short that the square of their
/// product leaves the range of float.
glm::vec3 unit_cross(glm::vec3 a, glm::vec3 b);

Surface surface_at(const Facet& facet, const Hit& hit);
Surface surface_at(const Sphere& sphere, const Ray& ray, const Hit& hit);
Surface surface_at(const Disk& disk, const Ray& ray, const Hit& hit);

/// Bends the shading normal as the normals of the mesh say, but never so far that the ray would
/// meet the other side.
void interpolate_normal(const Mesh& mesh, const Ray& ray, const Hit& hit, Surface& surface);

/// Texture coordinates of a point on a shape; `hit` gives triangle and barycentrics of a mesh.
glm::vec2 uv_at(const Shape& shape, glm::vec3 position, const Hit& hit);

/// A ray origin on the side of the surface that `direction` points to; for one path or eight.
template <class AnySurface, class Vector>
Vector offset_origin(const AnySurface& surface, const Vector& direction) {
  const auto front = dot(direction, surface.normal) >= 0.0f;
  return surface.position + surface.normal * (front ? surface.offset : -surface.offset);
}

}  // namespace quartet
