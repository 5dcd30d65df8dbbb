#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/view/ticks.h"

namespace quartet {

enum class ColorMapId { turbo, viridis, report, coolwarm };

/// One row of the table of colour maps. Knots are sRGB-encoded, in [0, 1], equally spaced from
/// t = 0 to t = 1, and joined by straight lines.
struct ColorMapRow {
  ColorMapId key;
  std::string_view id, label, source;
  std::span<const glm::vec3> knots;
};

std::span<const ColorMapRow> color_maps();
const ColorMapRow& color_map_row(ColorMapId key);

/// Throws std::invalid_argument that lists the legal ids.
const ColorMapRow& find_color_map(std::string_view id);

/// Pixels without a number (NaN) and pixels at the sample cap. No colour map contains these.
inline constexpr Rgba8 not_a_number_color{0, 0, 0, 255};
inline constexpr Rgba8 cap_color{255, 0, 255, 255};

/// The colour at t, clamped to [0, 1]; NaN gives not_a_number_color.
Rgba8 sample(ColorMapId color_map, float t);

/// How numbers lie along an axis or a colour bar.
enum class Spacing { linear, logarithmic };

/// What number has which colour: min is t = 0, max is t = 1. If max <= min, numbers up to min get
/// the colour of t = 0 and those above it the colour of t = 1. On a logarithmic scale both are
/// above 0.
struct ColorScale {
  double min = 0.0;
  double max = 1.0;
  ColorMapId color_map = ColorMapId::turbo;
  Spacing spacing = Spacing::linear;
  bool operator==(const ColorScale&) const = default;
};

float scale_position(const ColorScale& scale, double value);  ///< t in [0, 1], or NaN

/// Ticks for a colour bar of about `wanted`: its ends and round numbers between them; powers of ten
/// on a logarithmic scale.
std::vector<Tick> scale_ticks(const ColorScale& scale, int wanted);

/// Numbers as colours, one a number. Where the colours come from a table of 4097, they are off by
/// one step of 255 at most.
void apply(std::span<const float> numbers, const ColorScale& scale, std::span<Rgba8> display);

/// Samples per pixel as colours, exactly. Pixels with `cap` samples or more, the maximum a lane
/// allows, get cap_color.
void heatmap(std::span<const std::uint32_t> counts, const ColorScale& scale,
             std::optional<std::uint32_t> cap, std::span<Rgba8> display);

}  // namespace quartet
