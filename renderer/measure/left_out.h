#pragma once

#include <cstddef>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/measure/metrics.h"

namespace quartet {

// Metrics of pictures in which numbers are missing. A pixel that is NaN or infinite in one of the
// two says nothing: it is left out of both, and whoever asks counts it and says so. Where all
// pixels are finite the numbers are, to the bit, those of Metric.

/// Pixels that are not finite.
struct LeftOut {
  std::size_t test = 0;
  std::size_t reference = 0;
  std::size_t either = 0;         ///< that is left out
  std::vector<char> is_left_out;  ///< of each pixel
};

/// Both pictures have the same size.
LeftOut left_out_of(const RadianceImage& test, const RadianceImage& reference);

/// The metric over the pixels that are finite in both. FLIP sees the others black in both pictures
/// and leaves them out of its mean. Throws std::invalid_argument if the sizes differ or no pixel is
/// left.
double compute_over_finite(const Metric& metric, const RadianceImage& test,
                           const RadianceImage& reference);

/// Metric::map with 0 where a pixel is left out. Throws as above.
ScalarImage map_over_finite(const Metric& metric, const RadianceImage& test,
                            const RadianceImage& reference);

}  // namespace quartet
