#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/base/parallel.h"
#include "renderer/measure/metrics.h"

namespace quartet {

/// What metrics are made of: means and maps of terms. A term is what one channel of one pixel
/// contributes, of x and r; in double, where the square of any float is finite.
using MetricTerm = double(double, double);

inline double squared_difference(double x, double r) {
  return (x - r) * (x - r);
}

/// Pixels of a block; sums are made by block, whichever thread has it.
inline constexpr std::size_t metric_block = 4096;

/// The channels of a picture's pixels, one after the other.
inline std::span<const float> channels_of(const RadianceImage& image) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  return {&image.pixels().front().x, 3 * image.size()};
}

inline bool all_finite(std::span<const float> values) {
  int bad = 0;
  for (const float value : values) {
    bad |= std::abs(value) <= std::numeric_limits<float>::max() ? 0 : 1;  // of NaN, too
  }
  return bad == 0;
}

/// Calls body(block, begin, end) for every block of pixels.
template <class Body>
void for_metric_blocks(std::size_t pixels, const Body& body) {
  parallel_for((pixels + metric_block - 1) / metric_block, 1,
               [&](std::size_t first, std::size_t last) {
                 for (std::size_t block = first; block < last; ++block) {
                   body(block, block * metric_block, std::min(pixels, (block + 1) * metric_block));
                 }
               });
}

/// Throws std::invalid_argument, as Metric::compute does.
inline void require_comparable(const RadianceImage& test, const RadianceImage& reference) {
  require_same_size(test, reference);
  require_finite(test, "the test picture");
  require_finite(reference, "the reference");
}

/// A Metric::compute.
template <MetricTerm term>
double mean_over_values(const RadianceImage& test, const RadianceImage& reference) {
  require_same_size(test, reference);
  const std::span<const float> x = channels_of(test);
  const std::span<const float> r = channels_of(reference);
  std::vector<double> sums((test.size() + metric_block - 1) / metric_block);
  std::vector<char> finite(sums.size());
  for_metric_blocks(test.size(), [&](std::size_t block, std::size_t begin, std::size_t end) {
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
      sum += term(double(x[i]), double(r[i]));
    }
    sums[block] = sum;
    finite[block] = all_finite(x.subspan(3 * begin, 3 * (end - begin))) &&
                    all_finite(r.subspan(3 * begin, 3 * (end - begin)));
  });
  if (std::ranges::find(finite, 0) != finite.end()) {
    require_finite(test, "the test picture");
    require_finite(reference, "the reference");
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0) / double(x.size());
}

/// A Metric::errors, a number a channel. `error` is what a channel's term is the square of.
template <MetricTerm error>
std::vector<float> errors_of(const RadianceImage& test, const RadianceImage& reference) {
  require_comparable(test, reference);
  const std::span<const float> x = channels_of(test);
  const std::span<const float> r = channels_of(reference);
  std::vector<float> errors(x.size());
  for_metric_blocks(test.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
      errors[i] = float(error(double(x[i]), double(r[i])));
    }
  });
  return errors;
}

/// A Metric::map: the mean of each pixel's channels.
template <MetricTerm term>
ScalarImage map_of(const RadianceImage& test, const RadianceImage& reference) {
  require_comparable(test, reference);
  ScalarImage map(test.width(), test.height());
  for_metric_blocks(test.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::vec3 x = test.pixels()[i];
      const glm::vec3 r = reference.pixels()[i];
      map.pixels()[i] = float((term(x.r, r.r) + term(x.g, r.g) + term(x.b, r.b)) / 3.0);
    }
  });
  return map;
}

}  // namespace quartet
