#pragma once

#include <span>
#include <string_view>

#include "renderer/base/image.h"

namespace quartet {

enum class ToneMap { clamp, reinhard, filmic };

/// One row of the table of tone maps: what combo box, command line and tests walk.
struct ToneMapRow {
  ToneMap key;
  std::string_view id, label, source;
  /// Scales linear radiance, brings it into [0, 1] and encodes it as sRGB. Both spans have the
  /// same size.
  void (*encode)(std::span<const glm::vec3> radiance, float scale, std::span<Rgba8> display);
};

std::span<const ToneMapRow> tone_maps();
const ToneMapRow& tone_map_row(ToneMap key);

/// Throws std::invalid_argument that lists the legal ids.
const ToneMapRow& find_tone_map(std::string_view id);

/// The one way from linear radiance to display pixels, for the window and for files: times
/// 2^exposure_stops, through the tone map, to sRGB rounded to 8 bits. Negative and NaN become 0,
/// infinity becomes 1. The second form allocates nothing; its spans have the same size.
DisplayImage to_display(const RadianceImage& radiance, float exposure_stops = 0.0f,
                        ToneMap tone_map = ToneMap::clamp);
void to_display(std::span<const glm::vec3> radiance, float exposure_stops, ToneMap tone_map,
                std::span<Rgba8> display);

}  // namespace quartet
