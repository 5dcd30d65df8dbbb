#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "renderer/base/math/wide.h"

namespace quartet {

inline constexpr float pi = std::numbers::pi_v<float>;

/// The unit square onto the unit disk, keeping areas and neighbourhoods: Shirley and Chiu, "A Low
/// Distortion Map Between Disk and Square", JGT 2(3), 1997.
///
/// Without a branch, which would be mispredicted every other time, and with sine and cosine by
/// their series: the angle is at most π/4, where the terms left out are below 2⁻²⁴.
template <class F>
Vec2<F> square_to_disk(F u, F v) {
  const F x = 2.0f * u - 1.0f;
  const F y = 2.0f * v - 1.0f;
  const auto wide = abs(x) > abs(y);
  const F radius = wide ? x : y;
  const F other = wide ? y : x;
  const F a = radius == 0.0f ? F{} : (pi / 4.0f) * (other / radius);
  const F a2 = a * a;
  const F sine = radius * a * (1.0f + a2 * (-1.0f / 6 + a2 * (1.0f / 120 + a2 * (-1.0f / 5040))));
  const F cosine =
      radius *
      (1.0f + a2 * (-1.0f / 2 + a2 * (1.0f / 24 + a2 * (-1.0f / 720 + a2 * (1.0f / 40320)))));
  return {wide ? cosine : sine, wide ? sine : cosine};
}

/// The unit square onto barycentric coordinates. Folding the square keeps the stratification better
/// than the square root: Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
template <class F>
Vec2<F> square_to_triangle(F u, F v) {
  const auto upper = v > u;
  return {upper ? 0.5f * u : u - 0.5f * v, upper ? v - 0.5f * u : 0.5f * v};
}

/// The unit square onto the hemisphere around +z with density cos θ / π.
template <class F>
Vec3<F> square_to_cosine_hemisphere(F u, F v) {
  const Vec2<F> p = square_to_disk(u, v);
  return {p.x, p.y, sqrt(max_of(F{}, 1.0f - p.x * p.x - p.y * p.y))};
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
