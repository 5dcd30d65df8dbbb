#include "renderer/view/tone_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "renderer/base/table.h"
#include "renderer/files/srgb.h"

namespace quartet {

namespace {

float clamp_curve(float x) {
  return x;  // the encoder clamps
}

float reinhard_curve(float x) {
  return x / (1.0f + x);
}

float filmic_curve(float x) {
  return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
}

template <float (*curve)(float)>
void encode(std::span<const glm::vec3> radiance, float scale, std::span<Rgba8> display) {
  assert(radiance.size() == display.size());
  const Srgb8Encoder& srgb8 = srgb8_encoder();
  const auto bits_of = [scale](float value) {
    // An upper bound whose square is finite, so that no curve turns infinity into NaN.
    const float scaled = value * scale;
    const float positive = scaled > 0.0f ? scaled : 0.0f;
    return Srgb8Encoder::clamped_bits(curve(positive < 1e18f ? positive : 1e18f));
  };
  constexpr std::size_t block = 128;
  std::array<glm::uvec3, block> bits;
  for (std::size_t start = 0; start < radiance.size(); start += block) {
    const std::size_t size = std::min(block, radiance.size() - start);
    for (std::size_t i = 0; i < size; ++i) {
      const glm::vec3 c = radiance[start + i];
      bits[i] = {bits_of(c.r), bits_of(c.g), bits_of(c.b)};
    }
    for (std::size_t i = 0; i < size; ++i) {
      display[start + i] = {srgb8.look_up(bits[i].r), srgb8.look_up(bits[i].g),
                            srgb8.look_up(bits[i].b), 255};
    }
  }
}

constexpr std::array tone_map_table{
    ToneMapRow{ToneMap::clamp, "clamp", "Clamp", "radiance above 1 is cut to 1",
               encode<clamp_curve>},
    ToneMapRow{ToneMap::reinhard, "reinhard", "Reinhard",
               "Reinhard, Stark, Shirley, Ferwerda 2002, eq. 3, per channel",
               encode<reinhard_curve>},
    ToneMapRow{ToneMap::filmic, "filmic", "Filmic",
               "Narkowicz 2015, ACES filmic tone mapping curve (a fit), per channel",
               encode<filmic_curve>},
};

}  // namespace

std::span<const ToneMapRow> tone_maps() {
  return tone_map_table;
}

const ToneMapRow& tone_map_row(ToneMap key) {
  return row_of(tone_maps(), key);
}

const ToneMapRow& find_tone_map(std::string_view id) {
  return find_row(tone_maps(), id, "tone map");
}

DisplayImage to_display(const RadianceImage& radiance, float exposure_stops, ToneMap tone_map) {
  DisplayImage display(radiance.width(), radiance.height());
  to_display(radiance.pixels(), exposure_stops, tone_map, display.pixels());
  return display;
}

void to_display(std::span<const glm::vec3> radiance, float exposure_stops, ToneMap tone_map,
                std::span<Rgba8> display) {
  tone_map_row(tone_map).encode(radiance, std::exp2(exposure_stops), display);
}

}  // namespace quartet
