#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>

#include "renderer/scene/scene.h"

struct RTCSceneTy;

namespace quartet {

struct Ray {
  glm::vec3 origin;
  glm::vec3 direction;  ///< unit length
  float t_max = std::numeric_limits<float>::infinity();
};

struct Hit {
  float t;                  ///< distance along the ray
  glm::vec3 normal;         ///< geometric, not normalised; the front side of the shape
  float u, v;               ///< barycentric coordinates of triangle vertices 1 and 2
  std::uint32_t shape;      ///< index into Scene::shapes
  std::uint32_t primitive;  ///< triangle of the mesh, else 0
};

/// The shapes of a scene in an Embree hierarchy: the only file that knows Embree (3 or 4). Safe to
/// use from many threads. Single rays, because bounces are incoherent and because a ray must meet
/// the same surface whatever other rays are traced with it: packets differ in the last bit.
class Accel {
 public:
  /// Copies what it needs. Throws std::runtime_error if Embree refuses (out of memory).
  explicit Accel(const Scene& scene);

  /// The first surface along the ray within (0, t_max); false if there is none.
  bool closest_hit(const Ray& ray, Hit& hit) const;
  /// Whether anything lies within (0, t_max).
  bool occluded(const Ray& ray) const;

  glm::vec3 bounds_min() const { return bounds_min_; }
  glm::vec3 bounds_max() const { return bounds_max_; }

 private:
  struct Release {
    void operator()(RTCSceneTy* scene) const;
  };
  std::unique_ptr<RTCSceneTy, Release> scene_;
  glm::vec3 bounds_min_{0.0f};
  glm::vec3 bounds_max_{0.0f};
};

}  // namespace quartet
