#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace quartet {

/// Whether `a` and `b` are as long and at right angles, as the axes of a circle must be.
inline bool are_circle_axes(const glm::dvec3& a, const glm::dvec3& b) {
  constexpr double tolerance = 1e-4;  // matrices in files have about six digits
  const double length = std::max(glm::length(a), glm::length(b));
  return std::abs(glm::length(a) - glm::length(b)) <= tolerance * length &&
         std::abs(glm::dot(a, b)) <= tolerance * length * length;
}

}  // namespace quartet
