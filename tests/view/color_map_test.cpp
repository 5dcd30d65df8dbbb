#include "renderer/view/color_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "renderer/files/srgb.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

/// CIE L* of a display colour.
double lightness(Rgba8 c) {
  const double y = 0.2126 * srgb_decode(c.r / 255.0) + 0.7152 * srgb_decode(c.g / 255.0) +
                   0.0722 * srgb_decode(c.b / 255.0);
  return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

struct Published {
  ColorMapId color_map;
  float t;
  glm::vec3 color;
};

// Colours of the published tables that are no knots of ours, where the curves bend most.
const Published published_maps[] = {
    {ColorMapId::turbo, 7.0f / 255, {0.22111f, 0.15223f, 0.42558f}},
    {ColorMapId::turbo, 52.0f / 255, {0.23874f, 0.61931f, 0.99485f}},
    {ColorMapId::turbo, 83.0f / 255, {0.09662f, 0.88454f, 0.73316f}},
    {ColorMapId::turbo, 97.0f / 255, {0.20877f, 0.95304f, 0.58199f}},
    {ColorMapId::turbo, 127.0f / 255, {0.63323f, 0.99195f, 0.23937f}},
    {ColorMapId::turbo, 232.0f / 255, {0.74617f, 0.13098f, 0.00851f}},
    {ColorMapId::viridis, 7.0f / 255, {0.276022f, 0.044167f, 0.370164f}},
    {ColorMapId::viridis, 128.0f / 255, {0.127568f, 0.566949f, 0.550556f}},
    {ColorMapId::viridis, 172.0f / 255, {0.220124f, 0.725509f, 0.466226f}},
    {ColorMapId::viridis, 247.0f / 255, {0.916242f, 0.896091f, 0.100717f}},
    {ColorMapId::coolwarm, 1.0f / 32, glm::vec3(68, 90, 204) / 255.0f},
    {ColorMapId::coolwarm, 15.0f / 32, glm::vec3(213, 219, 230) / 255.0f},
    {ColorMapId::coolwarm, 17.0f / 32, glm::vec3(229, 216, 209) / 255.0f},
    {ColorMapId::coolwarm, 31.0f / 32, glm::vec3(192, 40, 47) / 255.0f},
};

TEST(ColorMap, StaysNearThePublishedColours) {
  for (const Published& published : published_maps) {
    const Rgba8 c = sample(published.color_map, published.t);
    for (int i = 0; i < 3; ++i) {
      const int value = i == 0 ? c.r : i == 1 ? c.g : c.b;
      EXPECT_NEAR(value, published.color[i] * 255.0f, 6.5)
          << color_map_row(published.color_map).id << " at " << published.t << ", channel " << i;
    }
  }
}

TEST(ColorMap, EndsAreThePublishedOnes) {
  EXPECT_EQ(sample(ColorMapId::turbo, 0.0f), (Rgba8{48, 18, 59, 255}));
  EXPECT_EQ(sample(ColorMapId::turbo, 1.0f), (Rgba8{122, 4, 3, 255}));
  EXPECT_EQ(sample(ColorMapId::viridis, 0.0f), (Rgba8{68, 1, 84, 255}));
  EXPECT_EQ(sample(ColorMapId::viridis, 1.0f), (Rgba8{253, 231, 37, 255}));
  EXPECT_EQ(sample(ColorMapId::coolwarm, 0.0f), (Rgba8{59, 76, 192, 255}));
  EXPECT_EQ(sample(ColorMapId::coolwarm, 0.5f), (Rgba8{221, 221, 221, 255}));
  EXPECT_EQ(sample(ColorMapId::coolwarm, 1.0f), (Rgba8{180, 4, 38, 255}));
}

TEST(ColorMap, ReportGoesFromBlueOverGreenToRed) {
  EXPECT_EQ(sample(ColorMapId::report, 0.0f), (Rgba8{0, 0, 255, 255}));
  EXPECT_EQ(sample(ColorMapId::report, 0.25f), (Rgba8{0, 128, 128, 255}));
  EXPECT_EQ(sample(ColorMapId::report, 0.5f), (Rgba8{0, 255, 0, 255}));
  EXPECT_EQ(sample(ColorMapId::report, 1.0f), (Rgba8{255, 0, 0, 255}));
}

TEST(ColorMap, ViridisGrowsLighterAllTheWay) {
  double last = 0.0;
  for (int i = 0; i <= 85; ++i) {
    const double now = lightness(sample(ColorMapId::viridis, float(i) / 85.0f));
    EXPECT_GT(now, last) << i;
    last = now;
  }
  EXPECT_GT(last, 90.0);
}

TEST(ColorMap, CoolwarmIsLightestInTheMiddle) {
  for (int i = 0; i < 32; ++i) {
    const float t = float(i) / 64.0f;
    const float next = float(i + 1) / 64.0f;
    EXPECT_LT(lightness(sample(ColorMapId::coolwarm, t)),
              lightness(sample(ColorMapId::coolwarm, next)));
    EXPECT_LT(lightness(sample(ColorMapId::coolwarm, 1.0f - t)),
              lightness(sample(ColorMapId::coolwarm, 1.0f - next)));
  }
}

TEST(ColorMap, EveryRowClampsIsContinuousAndLeavesTheSpecialColoursAlone) {
  for (const ColorMapRow& row : color_maps()) {
    SCOPED_TRACE(row.id);
    EXPECT_EQ(find_color_map(row.id).key, row.key);
    EXPECT_EQ(&color_map_row(row.key), &row);
    EXPECT_EQ(sample(row.key, -3.0f), sample(row.key, 0.0f));
    EXPECT_EQ(sample(row.key, 3.0f), sample(row.key, 1.0f));
    EXPECT_EQ(sample(row.key, std::numeric_limits<float>::quiet_NaN()), not_a_number_color);
    Rgba8 last = sample(row.key, 0.0f);
    for (int i = 0; i <= 1000; ++i) {
      const Rgba8 c = sample(row.key, float(i) / 1000.0f);
      EXPECT_LE(std::abs(c.r - last.r) + std::abs(c.g - last.g) + std::abs(c.b - last.b), 5) << i;
      EXPECT_NE(c, not_a_number_color);
      EXPECT_NE(c, cap_color);
      last = c;
    }
  }
  EXPECT_EQ(error_of([] { find_color_map("jet"); }),
            "unknown colour map 'jet'; there are: turbo, viridis, report, coolwarm");
}

DisplayImage heatmap_of(const Image<std::uint32_t>& counts, const ColorScale& scale,
                        std::optional<std::uint32_t> cap = std::nullopt) {
  DisplayImage display(counts.width(), counts.height());
  heatmap(counts.pixels(), scale, cap, display.pixels());
  return display;
}

TEST(Heatmap, SpansMinToMax) {
  Image<std::uint32_t> counts(3, 1);
  counts.at(0, 0) = 10;
  counts.at(1, 0) = 30;
  counts.at(2, 0) = 50;
  const DisplayImage heat = heatmap_of(counts, {10, 50, ColorMapId::report});
  EXPECT_EQ(heat.at(0, 0), (Rgba8{0, 0, 255, 255}));
  EXPECT_EQ(heat.at(1, 0), (Rgba8{0, 255, 0, 255}));
  EXPECT_EQ(heat.at(2, 0), (Rgba8{255, 0, 0, 255}));
}

TEST(Heatmap, AgreesWithSampleForSmallAndLargeCounts) {
  Image<std::uint32_t> counts(3000, 1);
  for (int x = 0; x < 3000; ++x) {
    counts.at(x, 0) = std::uint32_t(x);
  }
  const ColorScale scale{100, 2500, ColorMapId::viridis};
  const DisplayImage heat = heatmap_of(counts, scale, 2900u);
  for (int x = 0; x < 3000; ++x) {
    ASSERT_EQ(heat.at(x, 0),
              x >= 2900 ? cap_color : sample(ColorMapId::viridis, scale_position(scale, x)))
        << x;
  }
}

TEST(Heatmap, MarksPixelsAtTheCap) {
  Image<std::uint32_t> counts(3, 1);
  counts.at(0, 0) = 63;
  counts.at(1, 0) = 64;
  counts.at(2, 0) = 65;
  const DisplayImage heat = heatmap_of(counts, {0, 64, ColorMapId::turbo}, 64u);
  EXPECT_EQ(heat.at(0, 0), sample(ColorMapId::turbo, 63.0f / 64.0f));
  EXPECT_EQ(heat.at(1, 0), cap_color);
  EXPECT_EQ(heat.at(2, 0), cap_color);
}

TEST(Heatmap, AnEmptyRangeIsTheLowEnd) {
  const DisplayImage heat = heatmap_of(Image<std::uint32_t>(2, 2, 8u), {8, 8, ColorMapId::report});
  EXPECT_EQ(heat, DisplayImage(2, 2, {0, 0, 255, 255}));
}

TEST(Apply, ShowsNaNAndInfinity) {
  ScalarImage numbers(4, 1);
  numbers.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
  numbers.at(1, 0) = std::numeric_limits<float>::infinity();
  numbers.at(2, 0) = -std::numeric_limits<float>::infinity();
  numbers.at(3, 0) = 0.0f;
  DisplayImage display(4, 1);
  apply(numbers.pixels(), {-1, 1, ColorMapId::coolwarm}, display.pixels());
  EXPECT_EQ(display.at(0, 0), not_a_number_color);
  EXPECT_EQ(display.at(1, 0), sample(ColorMapId::coolwarm, 1.0f));
  EXPECT_EQ(display.at(2, 0), sample(ColorMapId::coolwarm, 0.0f));
  EXPECT_EQ(display.at(3, 0), sample(ColorMapId::coolwarm, 0.5f));
}

TEST(Apply, AgreesWithSampleOnBothSpacings) {
  for (const ColorScale& scale : {ColorScale{-3, 5, ColorMapId::turbo, Spacing::linear},
                                  ColorScale{1e-6, 10, ColorMapId::turbo, Spacing::logarithmic}}) {
    std::vector<float> numbers{0.0f, -1.0f, 1e-38f, 1e30f};
    for (float value = 1e-7f; value < 100.0f; value *= 1.01f) {
      numbers.push_back(value);
    }
    std::vector<Rgba8> display(numbers.size());
    apply(numbers, scale, display);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const Rgba8 exact = sample(scale.color_map, scale_position(scale, double(numbers[i])));
      EXPECT_LE(std::abs(display[i].r - exact.r), 1) << numbers[i];
      EXPECT_LE(std::abs(display[i].g - exact.g), 1) << numbers[i];
      EXPECT_LE(std::abs(display[i].b - exact.b), 1) << numbers[i];
    }
  }
}

TEST(Apply, ALogarithmicScaleHasItsGeometricMeanInTheMiddle) {
  const ColorScale scale{1e-4, 1, ColorMapId::viridis, Spacing::logarithmic};
  EXPECT_EQ(scale_position(scale, 1e-4), 0.0f);
  EXPECT_FLOAT_EQ(scale_position(scale, 1e-2), 0.5f);
  EXPECT_EQ(scale_position(scale, 1.0), 1.0f);
  EXPECT_EQ(scale_position(scale, 0.0), 0.0f);
  EXPECT_EQ(scale_position(scale, -1.0), 0.0f);
}

}  // namespace
}  // namespace quartet
