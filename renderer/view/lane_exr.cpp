#include "renderer/view/lane_exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "renderer/measure/metrics.h"
#include "renderer/view/views.h"

namespace quartet {

ExrImage lane_exr(const Snapshot& snapshot, std::size_t lane) {
  constexpr std::array channel_names{"R", "G", "B"};
  const LaneSnapshot& from = snapshot.lanes[lane];
  const std::size_t pixels = snapshot.pixels();
  ExrImage exr(snapshot.width, snapshot.height);
  for (std::size_t c = 0; c < 3; ++c) {
    exr.add(channel_names[c], from.mean[c]);
  }
  std::vector<float> rejected(from.rejected.begin(), from.rejected.end());
  rejected.resize(pixels, 0.0f);
  std::vector<float> in_mean(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    in_mean[i] = float(from.taken[i] - (from.rejected.empty() ? 0 : from.rejected[i]));
  }
  exr.add("SampleCount", std::move(in_mean));
  exr.add("Rejected", std::move(rejected));

  const auto plane = [&](const std::vector<float>& planes, std::size_t c) {
    const auto first = planes.begin() + std::ptrdiff_t(c * pixels);
    return std::vector<float>(first, first + std::ptrdiff_t(pixels));
  };
  const Estimator& row = estimator(from.settings.estimator);
  for (std::size_t c = 0; c < from.error.size() / pixels; ++c) {
    exr.add(row.channels == 1 ? fmt::format("Error.{}", row.id)
                              : fmt::format("Error.{}.{}", row.id, channel_names[c]),
            plane(from.error, c));
  }
  for (std::size_t c = 0; c < from.variance.size() / pixels; ++c) {
    exr.add(fmt::format("{}.{}", sampler_row(snapshot.settings.sampler).variance_channel,
                        channel_names[c]),
            plane(from.variance, c));
  }
  if (snapshot.reference) {
    const ScalarImage map =
        metric(MetricId::mse).map(radiance_image(snapshot, lane), *snapshot.reference);
    std::vector<float> squared(map.pixels().begin(), map.pixels().end());
    for (float& error : squared) {
      error = std::min(error, std::numeric_limits<float>::max());
    }
    exr.add("SquaredError", std::move(squared));
  }
  return exr;
}

}  // namespace quartet
