#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/trace/surface.h"

namespace quartet {

/// A direction towards a light, seen from a point.
struct LightSample {
  glm::vec3 direction;  ///< unit length
  float distance;       ///< free way needed along it, already short of the light itself
  glm::vec3 radiance;   ///< zero where the light does not shine at the point
  float pdf;      ///< 1/sr, with the probability of choosing this light; that alone of a point
  bool is_point;  ///< no ray meets it but this one
};

/// The same of eight points.
struct LightSample8 {
  Vec8 direction;
  Float8 distance;
  Vec8 radiance;
  Float8 pdf;
  Mask8 is_point;
};

/// All emitters of a scene, chosen with a probability proportional to their power; where there are
/// dim ones beside bright ones, each has a small one at least.
class Lights {
 public:
  /// `scene` is referred to, and must outlive this.
  Lights(const Scene& scene, glm::vec3 bounds_min, glm::vec3 bounds_max);

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
  enum class Kind { parallelogram, triangle, disk, point, sphere, environment };

  struct alignas(64) Light {
    glm::vec3 origin{0.0f};  // a corner, or the centre
    glm::vec3 edge1{0.0f};   // of a disk: two radii at right angles
    glm::vec3 edge2{0.0f};
    glm::vec3 normal{0.0f};    // of flat lights
    glm::vec3 radiance{0.0f};  // where no texture varies it; of a point, W/sr
    float density = 0.0f;      // of sampling a point of it: probability / area; of a point, 0
    Kind kind = Kind::environment;
    bool textured = false;
    float radius = 0.0f;
    float area = 0.0f;
    std::uint32_t shape = 0;
    std::uint32_t primitive = 0;
    float probability = 0.0f;
  };
  struct Choice {
    const Light* light;
    float u;
  };

  void add(std::uint32_t shape_index, const Mesh& mesh);
  void add(std::uint32_t shape_index, const Sphere& sphere);
  void add(std::uint32_t shape_index, const Disk& disk);
  void choose_by_power(glm::vec3 bounds_min, glm::vec3 bounds_max);
  Choice choose(float u, float v) const;
  LightSample sample(const Light& light, glm::vec3 from, float u, float v) const;
  void sample_sphere(const Light& light, glm::vec3 from, float u, float v, LightSample& s) const;
  void sample_flat(const Light& light, glm::vec3 from, float u, float v, LightSample& s) const;
  /// At a point of the light; `on_edges` is its place along the edges of a flat one.
  glm::vec3 radiance_at(const Light& light, glm::vec3 position, glm::vec2 on_edges) const;

  const Scene* scene_;
  std::vector<Light> lights_;
  std::vector<float> cdf_;           // one a light, ends in 1
  std::vector<int> first_of_shape_;  // first light of a shape; −1 where it does not emit
  int environment_ = -1;
  bool can_be_met_ = false;
};

}  // namespace quartet
