#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/trace/integrator.h"

namespace quartet {

/// Parts of the 2021 report's picture that its findings speak of.
enum class RegionId {
  ceiling,
  bright_squares,
  dark_squares,
  bright_borders,
  dark_borders,
  glass_ball,
  mirror_ball,
  ball_shadow,
  floor,
  box_front,
  green_wall,
  red_wall,
  margin,
  outlines,
  rest,
};

/// One row of the table of regions.
struct Region {
  RegionId key;
  std::string_view id;     ///< in files
  std::string_view label;  ///< for people
  std::string_view definition;
};

std::span<const Region> regions();
const Region& region(RegionId key);

/// The region of every pixel, in rows from the top left, by what the ray through its centre meets.
/// A pixel whose 3×3 neighbourhood meets another shape, or another face of the box, belongs to the
/// outlines: there a window of 3×3 pixels sees both. Throws std::runtime_error that names a shape
/// of the report's scene which the scene lacks.
std::vector<RegionId> find_regions(const TraceScene& scene, const RenderSettings& settings);

}  // namespace quartet
