#pragma once

#include <span>

#include "renderer/adaptive/estimators/estimator.h"

namespace quartet {

/// The criteria of window.h over the 3 × 3 neighbourhood of pixel means around every pixel; at the
/// border the window holds the 6 or 4 pixels that exist. Single precision, in forms that keep
/// their digits for nearly equal values and are exactly 0 for equal ones.

/// `error` is three planes: R, G, B.
void estimate_contrast(const EstimatorInput& input, std::span<float> error);
/// `error` is one plane each.
void estimate_kl(const EstimatorInput& input, std::span<float> error);
void estimate_chi2(const EstimatorInput& input, std::span<float> error);
void estimate_hellinger(const EstimatorInput& input, std::span<float> error);

}  // namespace quartet
