#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace quartet {

inline constexpr float pi = std::numbers::pi_v<float>;

/// An orthonormal basis around a unit normal: Duff et al., "Building an Orthonormal Basis,
/// Revisited", JCGT 6(1), 2017.
struct Frame {
  glm::vec3 s, t, n;

  explicit Frame(glm::vec3 normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    s = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t = {b, sign + n.y * n.y * a, -n.y};
  }

  glm::vec3 to_world(glm::vec3 v) const { return v.x * s + v.y * t + v.z * n; }
  glm::vec3 to_local(glm::vec3 v) const { return {glm::dot(v, s), glm::dot(v, t), glm::dot(v, n)}; }
};

/// The unit square onto the unit disk, keeping areas and neighbourhoods: Shirley and Chiu, "A Low
/// Distortion Map Between Disk and Square", JGT 2(3), 1997.
///
/// Without a branch, which would be mispredicted every other time, and with sine and cosine by
/// their series: the angle is at most π/4, where the terms left out are below 2⁻²⁴.
inline glm::vec2 square_to_disk(float u, float v) {
  const float x = 2.0f * u - 1.0f;
  const float y = 2.0f * v - 1.0f;
  const bool wide = std::abs(x) > std::abs(y);
  const float radius = wide ? x : y;
  const float other = wide ? y : x;
  const float a = radius == 0.0f ? 0.0f : (pi / 4.0f) * (other / radius);
  const float a2 = a * a;
  const float sine =
      radius * a * (1.0f + a2 * (-1.0f / 6 + a2 * (1.0f / 120 + a2 * (-1.0f / 5040))));
  const float cosine =
      radius *
      (1.0f + a2 * (-1.0f / 2 + a2 * (1.0f / 24 + a2 * (-1.0f / 720 + a2 * (1.0f / 40320)))));
  return wide ? glm::vec2(cosine, sine) : glm::vec2(sine, cosine);
}

/// The unit square onto the hemisphere around +z with density cos θ / π.
inline glm::vec3 square_to_cosine_hemisphere(float u, float v) {
  const glm::vec2 p = square_to_disk(u, v);
  return {p.x, p.y, std::sqrt(std::max(0.0f, 1.0f - p.x * p.x - p.y * p.y))};
}

/// The unit square onto the cap of the unit sphere around +z with cos θ ≥ `cos_max`, uniformly.
/// cos_max = −1 is the whole sphere.
inline glm::vec3 square_to_uniform_cap(float u, float v, float cos_max) {
  const float z = 1.0f - u * (1.0f - cos_max);
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const float phi = 2.0f * pi * v;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace quartet
