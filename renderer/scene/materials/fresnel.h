#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace quartet {

/// Unpolarised Fresnel reflectance of a smooth dielectric. `cos_i` > 0; `eta` is the index on the
/// far side over the index on the near side; `cos_t` receives the cosine of the transmitted angle,
/// 0 at total internal reflection.
inline float fresnel_dielectric(float cos_i, float eta, float& cos_t) {
  const float sin2_t = (1.0f - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1.0f) {
    cos_t = 0.0f;
    return 1.0f;
  }
  cos_t = std::sqrt(1.0f - sin2_t);
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// The same for a conductor with complex index eta + i k relative to the near side.
inline glm::vec3 fresnel_conductor(float cos_i, glm::vec3 eta, glm::vec3 k) {
  // Born and Wolf, "Principles of Optics", section 14.2, without complex numbers.
  const float cos2 = cos_i * cos_i;
  const float sin2 = 1.0f - cos2;
  const glm::vec3 t0 = eta * eta - k * k - sin2;
  const glm::vec3 a2_plus_b2 = glm::sqrt(t0 * t0 + 4.0f * eta * eta * k * k);
  const glm::vec3 a = glm::sqrt(glm::max(glm::vec3(0.0f), 0.5f * (a2_plus_b2 + t0)));
  const glm::vec3 t1 = a2_plus_b2 + cos2;
  const glm::vec3 t2 = 2.0f * cos_i * a;
  const glm::vec3 perpendicular = (t1 - t2) / (t1 + t2);
  const glm::vec3 t3 = cos2 * a2_plus_b2 + sin2 * sin2;
  const glm::vec3 t4 = t2 * sin2;
  const glm::vec3 parallel = perpendicular * (t3 - t4) / (t3 + t4);
  return 0.5f * (parallel + perpendicular);
}

}  // namespace quartet
