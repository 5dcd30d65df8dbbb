#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "renderer/adaptive/estimators/divergence.h"
#include "renderer/base/image.h"

namespace quartet {

/// Error of one window of RGB values, straight from the definitions: what the criteria mean. The
/// kernels in window_kernels.cpp compute the same for every pixel of a picture; the tests hold the
/// two against each other.
///
/// T is float or double; a window is three spans of equal length n ≥ 1, linear radiance ≥ 0.
template <class T>
struct PixelWindow {
  std::span<const T> r, g, b;

  std::size_t size() const { return r.size(); }
  T luminance(std::size_t i) const { return quartet::luminance(r[i], g[i], b[i]); }
  T mean_luminance() const {
    T sum = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      sum += luminance(i);
    }
    return sum / T(size());
  }
};

/// Mitchell, "Generating Antialiased Images at Low Sampling Densities", SIGGRAPH 1987: the contrast
/// of one channel, (max − min)/(max + min); 0 where both are 0.
template <class T>
T contrast(std::span<const T> channel) {
  const auto [low, high] = std::minmax_element(channel.begin(), channel.end());
  return *high > T(0) ? (*high - *low) / (*high + *low) : T(0);
}

/// One window value's part of n · D; `x` is L_i / L̄. The part of kl is x ln x − x + 1: the extra
/// terms cancel over a window and keep each part at zero or above.
template <class T>
T divergence_part(Divergence divergence, T x) {
  switch (divergence) {
    case Divergence::kl:
      return x > T(0) ? x * std::log(x) - x + T(1) : T(1);
    case Divergence::chi2:
      return (x - T(1)) * (x - T(1));
    case Divergence::hellinger:
      break;
  }
  return T(0.5) * (std::sqrt(x) - T(1)) * (std::sqrt(x) - T(1));
}

template <class T>
T divergence_error(Divergence divergence, const PixelWindow<T>& window) {
  const T mean = window.mean_luminance();
  if (!(mean > T(0))) {
    return T(0);
  }
  T sum = 0;
  for (std::size_t i = 0; i < window.size(); ++i) {
    sum += divergence_part(divergence, window.luminance(i) / mean);
  }
  const T n = T(window.size());
  return mean / n * std::sqrt(std::max(sum, T(0)) / n);
}

}  // namespace quartet
