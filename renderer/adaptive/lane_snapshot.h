#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/adaptive/histogram.h"
#include "renderer/adaptive/lane.h"

namespace quartet {

/// What one lane looked like at the end of a pass: plain data, copied out of the lane, so that it
/// may be kept and read while the lane goes on. Pixels are in rows from the top left.
struct LaneSnapshot {
  LaneSettings settings;
  std::array<std::vector<float>, 3> mean;  ///< linear radiance: red, green, blue of every pixel
  std::vector<std::uint32_t> taken;        ///< samples each pixel has used, rejected ones included
  std::vector<std::uint32_t> rejected;     ///< of these, a pixel; empty if none was
  /// Raw, in the estimator's unit: its channels × pixels; empty for an estimator without one.
  std::vector<float> error;
  /// Of the pixel mean as far as the sampler tells it (SamplerRow::variance): red, green, blue ×
  /// pixels, in radiance²; the largest float where that is less; empty where the films keep none.
  std::vector<float> variance;
  std::vector<PassRecord> history;               ///< see pass_history.h; back() is the current one
  Plan plan;                                     ///< of the next pass
  SampleHistogram sample_histogram;              ///< of `taken`
  std::vector<ErrorHistogram> error_histograms;  ///< one a channel of the estimator
};

/// Overwrites the snapshot with what the lane looks like now, using again what memory it has.
void copy_lane(const Lane& lane, LaneSnapshot& snapshot);

}  // namespace quartet
