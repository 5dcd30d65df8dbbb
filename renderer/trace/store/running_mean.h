#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace quartet {

/// Whether a sample may enter a statistic: no component is negative, infinite or NaN.
inline bool acceptable(const glm::vec3& sample) {
  constexpr float largest = std::numeric_limits<float>::max();
  return sample.x >= 0.0f && sample.x <= largest && sample.y >= 0.0f && sample.y <= largest &&
         sample.z >= 0.0f && sample.z <= largest;
}

/// The mean of samples in the order in which they come. The sum is in double: exact enough at 10⁷
/// samples. Store and film both take their means from here, so that they are equal to the bit.
struct RunningMean {
  glm::dvec3 sum{0.0};
  std::uint32_t count = 0;

  void add(const glm::vec3& sample) {
    sum += glm::dvec3(sample);
    ++count;
  }
  /// 0 of no samples.
  glm::vec3 mean() const {
    const double weight = count > 0 ? 1.0 / double(count) : 0.0;
    return {float(sum.x * weight), float(sum.y * weight), float(sum.z * weight)};
  }
};

}  // namespace quartet
