#pragma once

#include <glm/glm.hpp>

#include "renderer/base/math/wide.h"

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

// A shadow ray stops short of the light by more than the rounding error of both ends.
inline constexpr float short_of_light = 1.0f - 1e-4f;

}  // namespace quartet
