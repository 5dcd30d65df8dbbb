#include "renderer/view/quality_chart.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quartet {
namespace {

constexpr Rgba8 quality_accent{255, 160, 40};

EstimatorQuality quality_example() {
  EstimatorQuality quality;
  quality.calibration = {{0.0, 0.5, 7}, {0.1, 1e-4, 10}, {0.5, 1e-3, 10}, {3.0, 1e-2, 10}};
  quality.rank_correlation = 0.834;
  quality.stops = {80, 20, 8};
  return quality;
}

TEST(QualityChart, HasAPointAGroupAndSaysTheCorrelation) {
  const Chart chart = quality_chart(quality_example(), "kl", quality_accent);
  ASSERT_EQ(chart.lines.size(), 1u);
  EXPECT_EQ(chart.lines[0].points.size(), 3u) << "an error of 0 has no place on the axis";
  for (const glm::dvec2& point : chart.lines[0].points) {
    EXPECT_GE(axis_position(chart.x, point.x), 0.0);
    EXPECT_LE(axis_position(chart.x, point.x), 1.0);
    EXPECT_GE(axis_position(chart.y, point.y), 0.0);
    EXPECT_LE(axis_position(chart.y, point.y), 1.0);
  }
  ASSERT_EQ(chart.shades.size(), 1u);
  EXPECT_EQ(chart.shades[0].begin, 1.0) << "what is beyond the threshold";
  ASSERT_EQ(chart.texts.size(), 1u);
  EXPECT_EQ(chart.texts[0].text, "rank correlation 0.83, 10 % false stops");
}

TEST(QualityChart, WithoutErrorsItSaysSo) {
  EstimatorQuality quality;
  quality.rank_correlation = std::nan("");
  const Chart chart = quality_chart(quality, "uniform", quality_accent);
  EXPECT_TRUE(chart.lines.empty());
  ASSERT_EQ(chart.texts.size(), 1u);
}

}  // namespace
}  // namespace quartet
