#include "renderer/measure/capped.h"

#include <algorithm>

namespace quartet {

CappedPixels capped_pixels(std::span<const std::uint32_t> taken, const LaneSettings& settings) {
  const auto count = std::ranges::count_if(
      taken, [&](std::uint32_t samples) { return samples >= settings.max_spp; });
  return {std::size_t(count), taken.size(), settings.estimator, settings.max_spp};
}

CappedPixels capped_pixels(const Lane& lane) {
  return capped_pixels(lane.taken(), lane.settings());
}

void keep_most(CappedPixels& most, const CappedPixels& other) {
  if (other.count > most.count) {
    most = other;
  }
}

}  // namespace quartet
