#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/adaptive/estimators/estimator.h"

namespace quartet {

class Lane;
struct LaneSnapshot;
struct LaneSettings;

/// What a lane's criterion says of a pixel.
///
/// "Done" outranks "at the maximum": a pixel that is done asks for no more, however high the
/// maximum, also if it happens to be there. So those at the maximum are just the ones that the
/// maximum cut off, which a higher one would help. An estimator without an error has no pixel done:
/// all are refining, until they are at the maximum.
///
/// Whether a pixel that is refining gets samples is its policy's affair.
enum class PixelState : std::uint8_t {
  done,        ///< no error above its threshold, and not fewer than the minimum of samples
  refining,    ///< not done, and may have more samples
  at_maximum,  ///< not done, and has all samples that it may have
};

/// For people: "done", "refining", "at the maximum".
std::string_view pixel_state_label(PixelState state);

/// What decides about a lane's pixels. Looks into the errors and samples of what it is made from.
struct PixelCriterion {
  /// `pixel_errors` are channels × pixels, as an estimator writes them, or nothing where there are
  /// none (yet); `samples` are those that each pixel has used, rejected ones included.
  PixelCriterion(const LaneSettings& settings, std::span<const float> pixel_errors,
                 std::span<const std::uint32_t> samples);
  // Implicit: functions that take a criterion take a lane.
  PixelCriterion(const Lane& lane);
  PixelCriterion(const LaneSnapshot& lane);

  Thresholds thresholds;
  std::uint32_t minimum;  ///< samples
  std::uint32_t maximum;  ///< samples
  std::span<const float> error;
  std::span<const std::uint32_t> taken;
};

/// Sets marks[i] to 1 if pixel first + i is not done, to 0 if it is. Without errors no pixel is
/// done. NaN, which no estimator writes, is not above a threshold.
void mark_not_done(const PixelCriterion& criterion, std::size_t first,
                   std::span<std::uint8_t> marks);

PixelState pixel_state(const PixelCriterion& criterion, std::size_t pixel);
/// Of every pixel.
std::vector<PixelState> pixel_states(const PixelCriterion& criterion);

/// An error in units of its threshold: above 1 exactly where the error is above the threshold. The
/// quotient of a float and the next smaller one is more than half an ulp of 1 above 1, so that it
/// never rounds to it. With a threshold of 0 it is infinite or 0. Of NaN it is not above 1.
inline float scaled_error(float error, float threshold) {
  if (threshold > 0.0f) {
    return error / threshold;
  }
  return error > threshold ? std::numeric_limits<float>::infinity() : 0.0f;
}

/// The largest of a pixel's errors in units of their thresholds, without those that are NaN; 0 if
/// there are no errors. A pixel can be refining at 1 or less: with fewer samples than the minimum.
float largest_scaled_error(const PixelCriterion& criterion, std::size_t pixel);
/// Of every pixel; empty if there are no errors.
std::vector<float> largest_scaled_errors(const PixelCriterion& criterion);

}  // namespace quartet
