#include "renderer/image/pixel_values.h"

#include <algorithm>
#include <limits>

namespace quartet {
namespace {

/// An error in units of its threshold. With a threshold of 0 any error is above it.
float over_threshold(float error, float threshold) {
  if (threshold > 0.0f) {
    return error / threshold;
  }
  return error > threshold ? std::numeric_limits<float>::infinity() : 0.0f;
}

}  // namespace

std::vector<float> relative_error(const LaneSnapshot& lane) {
  const std::size_t pixels = lane.taken.size();
  if (lane.error.empty()) {
    return {};
  }
  std::vector<float> relative(pixels, 0.0f);
  for (std::size_t c = 0; c < lane.error.size() / pixels; ++c) {
    const float threshold = lane.policy.thresholds[c];
    const float* error = lane.error.data() + c * pixels;
    float* out = relative.data();
#pragma omp simd
    for (std::size_t i = 0; i < pixels; ++i) {
      const float each = over_threshold(error[i], threshold);
      out[i] = each > out[i] ? each : out[i];
    }
  }
  return relative;
}

PixelValues pixel_values(const LaneSnapshot& lane, std::size_t pixel) {
  const std::size_t pixels = lane.taken.size();
  PixelValues values;
  values.radiance = {lane.mean[0][pixel], lane.mean[1][pixel], lane.mean[2][pixel]};
  values.taken = lane.taken[pixel];
  values.rejected = lane.rejected.empty() ? 0 : lane.rejected[pixel];
  values.error_channels = int(lane.error.size() / pixels);
  for (std::size_t c = 0; c < std::size_t(values.error_channels); ++c) {
    values.error[c] = lane.error[c * pixels + pixel];
    values.relative_error =
        std::max(values.relative_error, over_threshold(values.error[c], lane.policy.thresholds[c]));
  }
  if (!lane.variance.empty()) {
    values.variance = {lane.variance[pixel], lane.variance[pixels + pixel],
                       lane.variance[2 * pixels + pixel]};
  }
  return values;
}

}  // namespace quartet
