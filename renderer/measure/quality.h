#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "renderer/adaptive/pixel_state.h"

namespace quartet {

class Film;
class Lane;

// How good an estimator is: what its errors say of the true ones, pixel by pixel. Errors are
// compared with the true squared error, the mean over the channels of (x − r)².

/// Pixels that an estimator finds about equally wrong, and how wrong they are.
struct CalibrationBin {
  double estimated = 0.0;           ///< mean of their estimated errors
  double true_squared_error = 0.0;  ///< mean
  std::size_t pixels = 0;
};

/// Pixels in the order of their estimated error, in about `bins` groups of as equal a size as ties
/// allow: those with the same estimate are in one bin. A good estimator gives a rising curve.
/// Pixels whose estimate is not finite are left out.
std::vector<CalibrationBin> calibration_curve(std::span<const float> estimated,
                                              std::span<const float> true_squared_error,
                                              std::size_t bins);

/// Spearman's rank correlation in [−1, 1]: Pearson's, of ranks, where values that tie have the mean
/// of their ranks. NaN where either side does not vary.
double rank_correlation(std::span<const float> a, std::span<const float> b);

/// Pixels that are done though they are worse than half of those that are not, refining or at the
/// maximum: their true error is above the median of theirs.
struct FalseStops {
  std::size_t done = 0;      ///< pixels
  std::size_t not_done = 0;  ///< pixels
  std::size_t wrong = 0;     ///< of those done

  /// Of the pixels done; NaN where either kind of pixel is missing, and with it the question.
  double share() const;
};

FalseStops false_stops(std::span<const PixelState> states,
                       std::span<const float> true_squared_error);

/// Share of the samples that lie elsewhere than an oracle would have put them: the total variation
/// distance ½ Σ |n_p / Σn − w_p / Σw| between the shares of the samples and those of the weights.
/// 0: the same everywhere; 1: nowhere both. NaN if either sum is 0.
double share_distance(std::span<const std::uint32_t> samples, std::span<const float> weights);

/// The weights of the oracle: the root of the variance of one sample, summed over the channels. A
/// given number of samples has the least mean squared error when they are spread in proportion to
/// it (Neyman, "On the Two Different Aspects of the Representative Method", 1934). `film` keeps
/// variances.
std::vector<float> oracle_weights(const Film& film);

/// What a lane's errors, in units of their thresholds, say of a picture that is off by
/// `true_squared_error`: of an estimator without an error nothing.
struct EstimatorQuality {
  double rank_correlation = std::numeric_limits<double>::quiet_NaN();
  FalseStops stops;
  std::vector<CalibrationBin> calibration;  ///< in 32 bins
};
EstimatorQuality quality_of(const PixelCriterion& criterion,
                            std::span<const float> true_squared_error);

}  // namespace quartet
