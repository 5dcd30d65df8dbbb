#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/trace/sampler_row.h"

namespace quartet {

/// The samples of a pixel by the sequences that they were dealt to (SamplerId::replicated), from
/// which the variance of their mean can be had though samples of one sequence are not independent:
/// Owen, "Monte Carlo Variance of Scrambled Net Quadrature", SIAM Journal on Numerical Analysis
/// 34(5), 1997.
struct Replicates {
  std::array<glm::dvec3, sampler_replicates> means{};
  std::array<std::uint32_t, sampler_replicates> counts{};

  /// Not from a sum: that of equal values is rounded, and they would seem to differ.
  void add(std::uint32_t index, const glm::dvec3& sample) {
    const std::uint32_t r = index % sampler_replicates;
    ++counts[r];
    means[r] += (sample - means[r]) / double(counts[r]);
  }
  /// Cuts the only sample there is at `most`.
  void cut(double most) {
    for (glm::dvec3& mean : means) {
      mean = min(mean, glm::dvec3(most));
    }
  }
};

/// An estimate of the variance of a pixel's mean.
struct MeanVariance {
  glm::dvec3 channels{0.0};
  double luminance = 0.0;
  /// What it is worth: that of so many + 1 independent numbers; 0 if it is not known.
  std::uint32_t freedom = 0;
};

/// Unbiased, whatever the law by which the variance of a sequence's mean falls with its length.
///
/// The mean is m = Σ w_r m_r with w_r = n_r / n, and its variance V = Σ w_r² σ_r². Each m_r has the
/// same expectation, so that
///   E (m_r − m)² = (1 − 2 w_r) σ_r² + V.
/// Of the estimates Σ c_r (m_r − m)² one has the expectation V for all σ_r: that with
///   c_r = w_r² / (1 − 2 w_r) / (1 + Q),   Q = Σ w_r² / (1 − 2 w_r),
/// which for equal w_r is the familiar 1/(R (R − 1)). It needs two sequences, and none with more
/// than half of the samples: above, σ_r of that one shows in no difference. At half, c_r is 1 and
/// the others 0, which is the limit. Samples are dealt out in turn, so that from two on this holds,
/// unless very many were rejected.
MeanVariance variance_of_mean(const Replicates& replicates);

}  // namespace quartet
