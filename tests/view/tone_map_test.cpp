#include "renderer/view/tone_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/files/srgb.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

Rgba8 display_of(glm::vec3 radiance, float stops, ToneMap tone_map) {
  return to_display(RadianceImage(1, 1, radiance), stops, tone_map).at(0, 0);
}

std::uint8_t encoded(double linear) {
  return std::uint8_t(std::lround(255.0 * srgb_encode(linear)));
}

TEST(ToneMap, ClampIsTheSrgbCurveCutAtOne) {
  EXPECT_EQ(display_of({0.18f, 0.5f, 3.0f}, 0.0f, ToneMap::clamp),
            (Rgba8{encoded(0.18), encoded(0.5), 255, 255}));
}

TEST(ToneMap, ExposureIsInStops) {
  EXPECT_EQ(display_of({0.1f, 0.2f, 0.3f}, 1.0f, ToneMap::clamp),
            display_of({0.2f, 0.4f, 0.6f}, 0.0f, ToneMap::clamp));
  EXPECT_EQ(display_of({0.8f, 0.4f, 0.2f}, -2.0f, ToneMap::clamp),
            display_of({0.2f, 0.1f, 0.05f}, 0.0f, ToneMap::clamp));
}

TEST(ToneMap, ReinhardHalvesOne) {
  EXPECT_EQ(display_of({1.0f, 3.0f, 0.0f}, 0.0f, ToneMap::reinhard),
            (Rgba8{encoded(0.5), encoded(0.75), 0, 255}));
}

TEST(ToneMap, FilmicAtOne) {
  // (2.51 + 0.03) / (2.43 + 0.59 + 0.14)
  EXPECT_EQ(display_of({1.0f, 1.0f, 1.0f}, 0.0f, ToneMap::filmic).r, encoded(2.54 / 3.16));
}

TEST(ToneMap, EveryRowIsMonotoneFromBlackAndSurvivesBadNumbers) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const ToneMapRow& row : tone_maps()) {
    SCOPED_TRACE(row.id);
    EXPECT_EQ(display_of({0.0f, -1.0f, nan}, 0.0f, row.key), (Rgba8{0, 0, 0, 255}));
    EXPECT_EQ(display_of({inf, 3e38f, 3e38f}, 4.0f, row.key), (Rgba8{255, 255, 255, 255}));
    int last = 0;
    for (float x = 1e-5f; x < 1e6f; x *= 1.01f) {
      const int value = display_of(glm::vec3(x), 0.0f, row.key).g;
      EXPECT_GE(value, last) << x;
      last = value;
    }
    EXPECT_EQ(last, 255);
  }
}

TEST(ToneMap, EveryPixelOfALongImageIsEncodedAlone) {
  RadianceImage radiance(1000, 1);
  for (int x = 0; x < 1000; ++x) {
    radiance.at(x, 0) = glm::vec3(0.001f, 0.0007f, 0.0003f) * float(x);
  }
  for (const ToneMapRow& row : tone_maps()) {
    const DisplayImage display = to_display(radiance, 0.5f, row.key);
    for (int x = 0; x < 1000; ++x) {
      ASSERT_EQ(display.at(x, 0), display_of(radiance.at(x, 0), 0.5f, row.key)) << x;
    }
  }
}

TEST(ToneMap, RowsHaveDistinctIdsThatAreFound) {
  for (const ToneMapRow& row : tone_maps()) {
    EXPECT_EQ(find_tone_map(row.id).key, row.key);
    EXPECT_EQ(&tone_map_row(row.key), &row);
    EXPECT_EQ(std::ranges::count(tone_maps(), row.id, &ToneMapRow::id), 1);
  }
  const std::string error = error_of([] { find_tone_map("gamma"); });
  EXPECT_EQ(error, "unknown tone map 'gamma'; there are: clamp, reinhard, filmic");
}

TEST(ToneMap, PixelsStayWhereTheyAre) {
  RadianceImage radiance(3, 2);
  radiance.at(2, 1) = {1.0f, 0.0f, 0.0f};
  const DisplayImage display = to_display(radiance);
  EXPECT_EQ(display.width(), 3);
  EXPECT_EQ(display.height(), 2);
  EXPECT_EQ(display.at(2, 1), (Rgba8{255, 0, 0, 255}));
  EXPECT_EQ(display.at(1, 1), (Rgba8{0, 0, 0, 255}));
}

}  // namespace
}  // namespace quartet
