#pragma once

#include <span>

#include "renderer/adaptive/estimators/estimator.h"

namespace quartet {

/// Estimators that look at the samples of each pixel by themselves, where window_kernels.h looks at
/// the means of its neighbours. Each writes one plane. Computed in double, so that no finite sample
/// leads out of its range; an error too large for float is its largest number.
///
/// Below two samples there is nothing to judge by, and the error is infinite; so it is where the
/// half of the samples that is compared with all of them is empty.

/// Purgathofer, "A Statistical Method for Adaptive Stochastic Sampling", Computers & Graphics
/// 11(2), 1987: half the width of the 95 % confidence interval of the mean luminance over that
/// mean, t(0.975, n − 1) · s / √n / max(L̄, 1e-3). Student's t, because n is small at first; the
/// floor keeps black pixels from wanting samples for ever.
void estimate_confidence(const EstimatorInput& input, std::span<float> error);

/// Lee, Redner and Uselton, "Statistically Optimized Sampling for Distributed Ray Tracing",
/// SIGGRAPH 1985: what the variance of the mean luminance stays below with 95 % confidence, were
/// samples normally distributed, (n − 1) s² / χ²(0.05, n − 1) / n.
void estimate_variance(const EstimatorInput& input, std::span<float> error);

/// Dammertz, Hanika, Keller and Lensch, "A Hierarchical Automatic Stopping Condition for Monte
/// Carlo Global Illumination", WSCG 2010, section 2.1, without its hierarchy: Σ abs(I − A) / √ΣI
/// over R, G, B, with I the mean of all samples and A that of every second one. 0 where I is black.
void estimate_half_buffer(const EstimatorInput& input, std::span<float> error);

/// The same as Blender Cycles 4 has it (adaptive_sampling.h of its kernel): A is the mean of class
/// A (which Cycles doubles the sum of, the same for a whole number of fours), and the sum of the
/// differences is divided by 1e-4 + √ΣI where ΣI < 1, and by 1e-4 + ΣI above. Divided by the 5 by
/// which Cycles multiplies its threshold, so that thresholds here are those of Cycles.
void estimate_cycles(const EstimatorInput& input, std::span<float> error);
/// Of Cycles too: a pixel is not done below max(4, ⌈16 / threshold^0.3⌉) samples.
std::uint32_t cycles_minimum(const Thresholds& thresholds);

/// Rigau, Feixas and Sbert 2003, the divergences of window.h over the samples of the pixel.
void estimate_rigau_kl(const EstimatorInput& input, std::span<float> error);
void estimate_rigau_chi2(const EstimatorInput& input, std::span<float> error);
void estimate_rigau_hellinger(const EstimatorInput& input, std::span<float> error);

/// The true squared error against the reference, mean of R, G and B: what a perfect estimator
/// would know. Infinite only for a pixel without samples.
void estimate_oracle(const EstimatorInput& input, std::span<float> error);

}  // namespace quartet
