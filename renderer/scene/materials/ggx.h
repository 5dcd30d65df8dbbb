#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "renderer/base/math/warp.h"

namespace quartet {

/// GGX normal distribution: Walter et al., "Microfacet Models for Refraction through Rough
/// Surfaces", EGSR 2007, eq. 33. The squared sine of the angle comes from x and y, because 1 − cos²
/// keeps no digits where alpha is small.
inline float ggx_distribution(glm::vec3 m, float alpha) {
  const float a2 = alpha * alpha;
  const float d = m.x * m.x + m.y * m.y + a2 * m.z * m.z;
  return a2 / (pi * d * d);
}

/// Smith masking for GGX, ibid. eq. 34. The product over both directions, as Mitsuba takes it, is
/// what makes public scenes look alike; the height-correlated form would be slightly brighter.
inline float ggx_masking(glm::vec3 w, float alpha) {
  const float tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return 2.0f / (1.0f + std::sqrt(1.0f + alpha * alpha * tan2));
}

/// A normal visible from `wo` (in the upper hemisphere): Heitz, "Sampling the GGX Distribution of
/// Visible Normals", JCGT 7(4), 2018.
inline glm::vec3 sample_visible_normal(glm::vec3 wo, float alpha, float u, float v) {
  const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * wo.x, alpha * wo.y, wo.z));
  glm::vec2 p = square_to_disk(u, v);
  const float across2 = stretched.x * stretched.x + stretched.y * stretched.y;
  const glm::vec3 t1 = across2 > 0.0f
                           ? glm::vec3(-stretched.y, stretched.x, 0.0f) / std::sqrt(across2)
                           : glm::vec3(1.0f, 0.0f, 0.0f);
  const glm::vec3 t2 = glm::cross(stretched, t1);
  const float s = 0.5f * (1.0f + stretched.z);
  p.y = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - p.x * p.x)) + s * p.y;
  const glm::vec3 n =
      p.x * t1 + p.y * t2 + std::sqrt(std::max(0.0f, 1.0f - p.x * p.x - p.y * p.y)) * stretched;
  return glm::normalize(glm::vec3(alpha * n.x, alpha * n.y, std::max(1e-6f, n.z)));
}

}  // namespace quartet
