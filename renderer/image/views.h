#pragma once

#include <span>

#include "renderer/adaptive/lane.h"
#include "renderer/image/color_map.h"
#include "renderer/image/exr.h"
#include "renderer/image/image.h"

namespace quartet {

/// How samples per pixel become colours.
enum class HeatRange {
  linked,  ///< 0 to the highest count of all lanes, so that colours compare
  report,  ///< lowest to highest count of each lane, blue-green-red: the 2021 report
};

/// The scale of one lane among those shown together.
ColorScale heat_scale(HeatRange range, std::span<const Lane> lanes, const Lane& lane);

/// Samples per pixel; pixels at the maximum of the lane's policy have a colour of their own.
DisplayImage heat_view(const Lane& lane, const ColorScale& scale);

/// Everything a lane knows about its pixels: R, G, B, SampleCount, Rejected, Error.<estimator>
/// (Error.<estimator>.R/G/B where it has three), and Variance.R/G/B of the mean where the film
/// keeps variance.
ExrImage lane_exr(const Lane& lane);

}  // namespace quartet
