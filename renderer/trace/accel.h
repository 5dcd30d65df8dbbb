#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <stop_token>

#include "renderer/base/math/wide.h"
#include "renderer/scene/scene.h"

struct RTCSceneTy;

namespace quartet {

template <class F>
struct RayOf {
  Vec3<F> origin;
  Vec3<F> direction;  ///< unit length
  F t_max = std::numeric_limits<float>::infinity() - F{};
};
using Ray = RayOf<float>;
using Ray8 = RayOf<Float8>;

struct Hit {
  float t;                  ///< distance along the ray
  float u, v;               ///< barycentric coordinates of triangle vertices 1 and 2
  std::uint32_t shape;      ///< index into Scene::shapes
  std::uint32_t primitive;  ///< triangle of the mesh, else 0
};

/// The same of eight rays, in the lanes that met something.
struct Hit8 {
  Mask8 met;
  Float8 t, u, v;
  Word8 shape, primitive;
};

/// The shapes of a scene in an Embree hierarchy: the only file that knows Embree (3 or 4). Safe to
/// use from many threads.
///
/// Rays go to Embree in packets of eight, single ones too. What a ray of a packet meets does not
/// depend, to the bit, on the other rays or on which there are (tests/trace/accel_test.cpp); but
/// it is not always what Embree's own single rays meet, which differ from packets in the last bits
/// of spheres. A ray that is not finite, or that begins 10^18 away or farther, meets nothing.
class Accel {
 public:
  /// Copies what it needs. Throws std::runtime_error if Embree refuses (out of memory), Cancelled
  /// soon after `stop` was asked for.
  explicit Accel(const Scene& scene, const std::stop_token& stop = {});

  /// The first surface along the ray within (0, t_max); false if there is none.
  bool closest_hit(const Ray& ray, Hit& hit) const;
  /// Whether anything lies within (0, t_max).
  bool occluded(const Ray& ray) const;

  /// The same for eight rays; only the lanes of `active` are looked at.
  Hit8 closest_hit(const Ray8& rays, Mask8 active) const;
  Mask8 occluded(const Ray8& rays, Mask8 active) const;

  /// For what wants to measure Embree itself.
  RTCSceneTy* embree_scene() const { return scene_.get(); }

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
