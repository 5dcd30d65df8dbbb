#pragma once

#include <cmath>
#include <cstdint>

#include "renderer/base/image.h"
#include "renderer/trace/store/sample_store.h"

namespace quartet::test {

/// A number in [0, 1) that belongs to (pixel, sample).
inline float hashed(std::uint32_t pixel, std::uint32_t index) {
  std::uint32_t x = pixel * 0x9e3779b9u + index * 0x85ebca6bu + 0x1234567u;
  for (const std::uint32_t multiplier : {0x21f0aaadu, 0x735a2d97u}) {
    x ^= x >> 16;
    x *= multiplier;
    x ^= x >> 15;
  }
  return float(x >> 8) * 0x1p-24f;
}

/// The true radiance of noisy_source(): rises from left to right.
inline float true_value(int x) {
  return 0.2f + 0.05f * float(x);
}

/// Pixels of true_value(), with noise that grows from none at the left. A pure function, as a
/// source must be, and its truth is known exactly.
inline SampleSource noisy_source(int width) {
  return [width](int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::uint32_t i = 0; i < radiance.size(); ++i) {
      const float u = hashed(std::uint32_t(y * width + x), first + i);
      radiance[i] = glm::vec3(true_value(x) * (1.0f + (2.0f * u - 1.0f) * float(x) / float(width)));
    }
  };
}

inline RadianceImage noisy_truth(int width, int height) {
  RadianceImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y) = glm::vec3(true_value(x));
    }
  }
  return image;
}

}  // namespace quartet::test
