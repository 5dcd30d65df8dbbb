#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/trace/lights/light.h"
#include "renderer/trace/surface.h"

namespace quartet {

/// All lights of a scene, chosen with a probability proportional to their power; where there are
/// dim ones beside bright ones, each has a small one at least.
class LightSampler {
 public:
  /// `scene` is referred to, and must outlive this. Throws std::runtime_error if it has too many
  /// lights.
  LightSampler(const Scene& scene, glm::vec3 bounds_min, glm::vec3 bounds_max);

  /// (u, v) in [0, 1)² chooses the point; u the light too, by its place among the probabilities.
  LightSample sample(glm::vec3 from, float u, float v) const;
  /// The same for the lanes of `wanted`.
  LightSample8 sample(const Vec8& from, Float8 u, Float8 v, Mask8 wanted) const;

  /// Density (1/sr) with which sample() finds the point `surface` of an emitting shape from `from`;
  /// `direction` is the unit vector there and `distance` the way.
  float pdf(const Surface& surface, glm::vec3 from, glm::vec3 direction, float distance) const;
  /// The same for a direction that meets no shape.
  float environment_pdf() const;

  /// Whether a ray can find light by meeting a shape that emits, or the environment.
  bool can_be_met() const { return can_be_met_; }

 private:
  struct Choice {
    const Light* light;
    float u;
  };

  void choose_by_power(float scene_radius);
  Choice choose(float u, float v) const;

  const Scene* scene_;
  std::vector<Light> lights_;
  std::vector<float> cdf_;           // one a light, ends in 1
  std::vector<int> first_of_shape_;  // first light of a shape; −1 where it does not emit
  int environment_ = -1;
  bool can_be_met_ = false;
};

}  // namespace quartet
