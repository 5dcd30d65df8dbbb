#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "renderer/adaptive/lane.h"

namespace quartet {

/// Pixels of a run that have as many samples as its settings let a pixel have: what they would have
/// been given without it nobody knows.
struct CappedPixels {
  std::size_t count = 0;
  std::size_t pixels = 0;  ///< of the picture
  EstimatorId estimator = EstimatorId::uniform;
  std::uint32_t most = 0;  ///< samples that a pixel may have
};

/// `taken` are samples of each pixel.
CappedPixels capped_pixels(std::span<const std::uint32_t> taken, const LaneSettings& settings);
/// Of what a lane shows.
CappedPixels capped_pixels(const Lane& lane);

/// Of several runs the one with most is told.
void keep_most(CappedPixels& most, const CappedPixels& other);

}  // namespace quartet
