#pragma once

#include <cassert>
#include <cstdint>
#include <limits>
#include <span>

#include "renderer/adaptive/estimators/estimator.h"
#include "renderer/base/parallel.h"

namespace quartet {

// For estimators that look at the samples of each pixel by themselves, where window_kernels.cpp
// looks at the means of its neighbours. Each writes one plane. Computed in double, so that no
// finite sample leads out of its range; an error too large for float is its largest number.

/// Pixels handed to one thread at a time; a smaller piece costs more to hand out than it gains.
inline constexpr std::size_t estimator_grain = 1 << 12;

/// The error of a pixel that cannot be judged: above every threshold.
inline constexpr double not_judged = std::numeric_limits<double>::infinity();

inline float error_to_float(double error) {
  constexpr double largest = std::numeric_limits<float>::max();
  return float(error > largest && error < not_judged ? largest : error);
}

/// Writes error_of(pixel, n) for each pixel, n its samples, where it has at least `fewest`.
template <class ErrorOf>
void each_pixel(const EstimatorInput& input, std::span<float> error, std::uint32_t fewest,
                const ErrorOf& error_of) {
  assert(error.size() == input.film.size());
  parallel_for(error.size(), estimator_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t n = input.film.counts()[i];
      error[i] = error_to_float(n < fewest ? not_judged : error_of(i, n));
    }
  });
}

/// The same where it has at least two, below which there is nothing to judge by.
template <class ErrorOf>
void each_judged_pixel(const EstimatorInput& input, std::span<float> error,
                       const ErrorOf& error_of) {
  each_pixel(input, error, 2, error_of);
}

/// Writes error_of(pixel, deviations, n) where the variance of a pixel's mean is known.
template <class ErrorOf>
void each_known_variance(const EstimatorInput& input, std::span<float> error,
                         const ErrorOf& error_of) {
  each_judged_pixel(input, error, [&](std::size_t i, std::uint32_t n) {
    const LuminanceDeviations deviations = input.film.luminance_deviations(i);
    return deviations.freedom == 0 ? not_judged : error_of(i, deviations, n);
  });
}

}  // namespace quartet
