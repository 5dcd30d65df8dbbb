#include "renderer/view/pixel_values.h"

namespace quartet {

PixelValues pixel_values(const LaneSnapshot& lane, std::size_t pixel) {
  const std::size_t pixels = lane.taken.size();
  PixelValues values;
  values.radiance = {lane.mean[0][pixel], lane.mean[1][pixel], lane.mean[2][pixel]};
  values.taken = lane.taken[pixel];
  values.rejected = lane.rejected.empty() ? 0 : lane.rejected[pixel];
  values.state = pixel_state(lane, pixel);
  values.scaled_error = largest_scaled_error(lane, pixel);
  values.error_channels = int(lane.error.size() / pixels);
  for (std::size_t c = 0; c < std::size_t(values.error_channels); ++c) {
    values.error[c] = lane.error[c * pixels + pixel];
  }
  if (!lane.variance.empty()) {
    values.variance = {lane.variance[pixel], lane.variance[pixels + pixel],
                       lane.variance[2 * pixels + pixel]};
  }
  return values;
}

}  // namespace quartet
