#include "renderer/view/lane_charts.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "tests/view/snapshot_cases.h"

namespace quartet {
namespace {

using test::blank_snapshot;
using test::finish;

constexpr Rgba8 accent{255, 160, 40};
constexpr std::array charted_lanes{EstimatorId::contrast, EstimatorId::kl, EstimatorId::uniform};

Snapshot charted_example() {
  Snapshot snapshot = blank_snapshot(100, 10, charted_lanes);
  for (LaneSnapshot& lane : snapshot.lanes) {
    for (std::size_t i = 0; i < lane.taken.size(); ++i) {
      lane.taken[i] = 1 + std::uint32_t(i % 40);
    }
    for (std::size_t i = 0; i < lane.error.size(); ++i) {
      lane.error[i] = 0.9f * float(i % 1000) / 1000.0f * lane.settings.thresholds[0] * 2.0f;
    }
    lane.plan.not_done = 310;
  }
  finish(snapshot);
  return snapshot;
}

TEST(Axis, PositionsAndValuesAreInverse) {
  for (const Axis& axis : {linear_axis(-2, 7, "", 4), decade_axis(-5, 1, "")}) {
    EXPECT_DOUBLE_EQ(axis_position(axis, axis.min), 0.0);
    EXPECT_DOUBLE_EQ(axis_position(axis, axis.max), 1.0);
    for (double position = -0.5; position < 1.5; position += 0.1) {
      EXPECT_NEAR(axis_position(axis, axis_value(axis, position)), position, 1e-12);
    }
  }
  EXPECT_LT(axis_position(decade_axis(-5, 1, ""), 0.0), 0.0);
}

TEST(Axis, DecadesAreLabelled) {
  const Axis axis = decade_axis(-3, 1, "error");
  std::string labels;
  for (const Tick& tick : axis.ticks) {
    labels += tick.label + " ";
  }
  EXPECT_EQ(labels, "10⁻³ 0.01 0.1 1 10 ");
}

TEST(Axis, LogarithmicOnesReachFromOneToTwoToFive) {
  Axis axis = log_axis(0.13, 37.0, "s", 6);
  EXPECT_DOUBLE_EQ(axis.min, 0.1);
  EXPECT_DOUBLE_EQ(axis.max, 50.0);
  EXPECT_EQ(axis.spacing, Spacing::logarithmic);
  axis = log_axis(0.2, 0.2, "", 6);
  EXPECT_DOUBLE_EQ(axis.min, 0.2);
  EXPECT_DOUBLE_EQ(axis.max, 2.0);
  for (const auto& [min, max] : {std::pair{0.0, 1.0}, {2.0, 1.0}, {std::nan(""), 1.0}}) {
    axis = log_axis(min, max, "", 6);
    EXPECT_EQ(axis.min, 0.1);
    EXPECT_EQ(axis.max, 1.0);
  }
}

TEST(Chart, ReadingsBetweenPointsAreStraightOnTheAxes) {
  Chart chart;
  chart.x = log_axis(1.0, 100.0, "seconds", 5);
  chart.y = log_axis(0.01, 1.0, "error", 5);
  chart.lines = {{"kl", accent, {{1.0, 1.0}, {100.0, 0.01}, {10.0, 0.5}}}};
  EXPECT_EQ(reading_at(chart, 10.0), "seconds 10, kl: 0.1") << "the first piece";
  EXPECT_EQ(reading_at(chart, 0.5), "");
}

TEST(SampleChart, HasABarACountInTheColoursOfTheHeatmap) {
  Snapshot snapshot = charted_example();
  snapshot.lanes[0].settings.max_spp = 40;
  const ColorScale scale{0, 40, ColorMapId::turbo};
  const Chart chart = sample_chart(snapshot, 0, scale);
  ASSERT_EQ(chart.bars.size(), 40u);
  EXPECT_EQ(chart.bars[4].begin, 5.0);
  EXPECT_EQ(chart.bars[4].end, 6.0);
  EXPECT_EQ(chart.bars[4].value, 25.0);
  EXPECT_EQ(chart.bars[4].color, sample(ColorMapId::turbo, 5.0f / 40.0f));
  EXPECT_EQ(chart.bars[39].color, cap_color);
  EXPECT_EQ(chart.y.spacing, Spacing::logarithmic);
  EXPECT_EQ(reading_at(chart, 5.5), "samples 5 to 6, pixels: 25");
  EXPECT_EQ(reading_at(chart, 100.0), "");
}

TEST(ErrorChart, OneChannelHasBarsOneMarkerAndTheShareThatIsNotDone) {
  const Snapshot snapshot = charted_example();
  Thresholds thresholds{0.002f, 0.0f, 0.0f};
  const Chart chart = error_chart(snapshot, 1, thresholds, accent);
  ASSERT_EQ(chart.markers.size(), 1u);
  EXPECT_EQ(chart.markers[0].id, 0);
  EXPECT_FLOAT_EQ(float(chart.markers[0].value), 0.002f) << "ahead of the lane's own";
  ASSERT_EQ(chart.shades.size(), 1u);
  EXPECT_EQ(chart.shades[0].begin, chart.markers[0].value);
  EXPECT_EQ(chart.shades[0].end, chart.x.max);
  ASSERT_FALSE(chart.texts.empty());
  EXPECT_EQ(chart.texts[0].text, "31 % of pixels are not done");
  double percent = 0.0;
  for (const Bar& bar : chart.bars) {
    percent += bar.value;
    EXPECT_EQ(bar.color.a == 255, std::sqrt(bar.begin * bar.end) > 0.002);
    EXPECT_LE(bar.value, chart.y.max);
  }
  EXPECT_NEAR(percent, 100.0, 0.5) << "all but the pixel without error and a curiosity";
  EXPECT_TRUE(chart.lines.empty());
}

TEST(ErrorChart, ContrastHasALineAndAMarkerAChannel) {
  const Snapshot snapshot = charted_example();
  const Thresholds thresholds = snapshot.lanes[0].settings.thresholds;
  const Chart chart = error_chart(snapshot, 0, thresholds, accent);
  EXPECT_TRUE(chart.bars.empty());
  EXPECT_EQ(chart.shades.size(), 3u);
  ASSERT_EQ(chart.lines.size(), 3u);
  ASSERT_EQ(chart.markers.size(), 3u);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(chart.markers[c].id, int(c));
    EXPECT_EQ(chart.markers[c].value, double(thresholds[c]));
    EXPECT_EQ(chart.markers[c].color, chart.lines[c].color);
    const double position = axis_position(chart.x, chart.markers[c].value);
    EXPECT_EQ(marker_near(chart, position + 0.005, 0.02), &chart.markers[c]);
  }
  EXPECT_EQ(marker_near(chart, 0.01, 0.005), nullptr);
}

TEST(ErrorChart, TheThresholdsAreAlwaysInsideWithRoomToDrag) {
  const Snapshot snapshot = charted_example();
  for (float threshold = 1e-7f; threshold < 1e3f; threshold *= 1.7f) {
    const Chart chart = error_chart(snapshot, 1, {threshold, 0.0f, 0.0f}, accent);
    const double position = axis_position(chart.x, double(threshold));
    EXPECT_GT(position, 0.02) << threshold;
    EXPECT_LT(position, 0.98) << threshold;
  }
}

TEST(ErrorChart, UniformSaysThatThereIsNoError) {
  const Snapshot snapshot = charted_example();
  const Chart chart = error_chart(snapshot, 2, {}, accent);
  EXPECT_TRUE(chart.bars.empty());
  EXPECT_TRUE(chart.markers.empty());
  ASSERT_EQ(chart.texts.size(), 1u);
  EXPECT_FALSE(chart.texts[0].text.empty());
}

TEST(ProgressChart, CumulatesAndStaysSmall) {
  Snapshot snapshot = charted_example();
  snapshot.pass = 10000;
  for (LaneSnapshot& lane : snapshot.lanes) {
    lane.history.clear();
    for (std::uint32_t pass = 1; pass <= snapshot.pass; ++pass) {
      PassRecord record;
      record.pass = pass;
      record.samples = std::uint64_t(pass) * 2000;
      lane.history.push_back(record);
    }
  }
  const Chart chart = progress_chart(snapshot, 1, accent);
  ASSERT_EQ(chart.lines.size(), 1u);
  const std::vector<glm::dvec2>& points = chart.lines[0].points;
  EXPECT_LE(points.size(), 600u);
  EXPECT_EQ(points.front(), glm::dvec2(0.0, 0.0));
  EXPECT_EQ(points.back(), glm::dvec2(10000.0, 20000.0));
  EXPECT_EQ(chart.lines[0].color, accent);
  EXPECT_EQ(reading_at(chart, 5000.0), "pass 5000, samples per pixel: 1e4");
}

}  // namespace
}  // namespace quartet
