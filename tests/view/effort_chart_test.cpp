#include "renderer/view/effort_chart.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "renderer/view/estimator_look.h"
#include "tests/view/snapshot_cases.h"

namespace quartet {
namespace {

using test::blank_snapshot;

constexpr std::array lanes{EstimatorId::contrast, EstimatorId::kl};
constexpr int width = 10;
constexpr int height = 10;

/// `passes` passes of so many samples a pixel and seconds each, whose error is gain / samples.
void fill(LaneSnapshot& lane, int passes, double spp, double seconds, double gain) {
  lane.history.clear();
  for (int pass = 1; pass <= passes; ++pass) {
    PassRecord record;
    record.pass = std::uint32_t(pass);
    record.samples = std::uint64_t(spp * pass * width * height);
    record.rays = 7 * record.samples;
    record.seconds = seconds * pass;
    record.truth.error = gain / (spp * pass);
    lane.history.push_back(record);
  }
}

/// Uniform sampling takes 1 sample and 1 second a pass; lane 1 twice that and gains nothing; lane
/// 2 has half the error of uniform sampling after the same seconds.
Snapshot example() {
  Snapshot snapshot = blank_snapshot(width, height, lanes);
  snapshot.reference = std::make_shared<const RadianceImage>(width, height);
  snapshot.metric = MetricId::mse;
  snapshot.baseline = snapshot.lanes[0];
  fill(*snapshot.baseline, 8, 1.0, 1.0, 1.0);
  fill(snapshot.lanes[0], 8, 2.0, 2.0, 1.0);
  fill(snapshot.lanes[1], 8, 0.5, 0.5, 0.5);
  return snapshot;
}

EffortChart against(Effort effort) {
  EffortChart what;
  what.effort = effort;
  return what;
}

const Line& line_of(const Chart& chart, int id) {
  static const Line none;
  for (const Line& line : chart.lines) {
    if (line.id == id) {
      return line;
    }
  }
  ADD_FAILURE() << "no line " << id;
  return none;
}

TEST(EffortChart, HasALineALaneWithAPointAPass) {
  const Chart chart = effort_chart(example(), against(Effort::seconds));
  for (int lane = 0; lane < 2; ++lane) {
    const Line& line = line_of(chart, lane);
    const EstimatorLook& look = look_of(lanes[std::size_t(lane)]);
    EXPECT_EQ(line.color, look.screen);
    EXPECT_EQ(line.shape, look.shape);
    EXPECT_EQ(line.dash, look.dash);
    ASSERT_EQ(line.points.size(), 8u);
  }
  EXPECT_EQ(line_of(chart, 0).points[2], glm::dvec2(6.0, 1.0 / 6.0));
  const Chart by_spp = effort_chart(example(), against(Effort::mean_spp));
  EXPECT_EQ(line_of(by_spp, 1).points[3], glm::dvec2(2.0, 0.25));
  const Chart by_rays = effort_chart(example(), against(Effort::rays));
  EXPECT_EQ(line_of(by_rays, 1).points[3], glm::dvec2(14.0, 0.25));
  for (const Chart* each : {&chart, &by_spp, &by_rays}) {
    EXPECT_EQ(each->x.spacing, Spacing::logarithmic);
    EXPECT_EQ(each->y.spacing, Spacing::logarithmic);
    for (const Line& line : each->lines) {
      for (const glm::dvec2& point : line.points) {
        EXPECT_GE(axis_position(each->x, point.x), 0.0);
        EXPECT_LE(axis_position(each->x, point.x), 1.0);
        EXPECT_GE(axis_position(each->y, point.y), 0.0);
        EXPECT_LE(axis_position(each->y, point.y), 1.0);
      }
    }
  }
}

TEST(EffortChart, UniformSamplingIsShownAsFarAsItWasMeasured) {
  const Chart chart = effort_chart(example(), against(Effort::seconds));
  const Line& uniform = line_of(chart, -1);
  ASSERT_EQ(uniform.points.size(), 8u);
  EXPECT_EQ(uniform.points.back(), glm::dvec2(8.0, 1.0 / 8.0));
  EXPECT_EQ(uniform.color, look_of(EstimatorId::uniform).screen);
}

TEST(EffortChart, LanesOfOneEstimatorDifferInTheirDashes) {
  Snapshot snapshot = example();
  snapshot.lanes[1].settings.estimator = snapshot.lanes[0].settings.estimator;
  const Chart chart = effort_chart(snapshot, against(Effort::seconds));
  EXPECT_EQ(line_of(chart, 0).color, line_of(chart, 1).color);
  EXPECT_EQ(line_of(chart, 1).dash, Dash::dotted);
  EXPECT_NE(line_of(chart, 0).dash, Dash::dotted);
}

TEST(EffortChart, TheNoiseFloorIsALevelInSight) {
  EffortChart what = against(Effort::seconds);
  what.noise_floor = 1e-5;
  const Chart chart = effort_chart(example(), what);
  ASSERT_EQ(chart.levels.size(), 1u);
  EXPECT_EQ(chart.levels[0].value, 1e-5);
  EXPECT_GE(axis_position(chart.y, 1e-5), 0.0);
}

TEST(EffortChart, WithoutErrorsItSaysSo) {
  const Snapshot snapshot = blank_snapshot(width, height, lanes);
  const Chart chart = effort_chart(snapshot, against(Effort::seconds));
  EXPECT_TRUE(chart.lines.empty());
  ASSERT_EQ(chart.texts.size(), 1u);
  EXPECT_FALSE(times_uniform(snapshot, 0, Effort::seconds));
  EXPECT_FALSE(baseline_error(snapshot, Effort::seconds, 1.0));
}

TEST(EffortChart, TimesUniformIsAtTheSameEffort) {
  const Snapshot snapshot = example();
  // After 16 s nobody knows where uniform sampling would be: it was measured up to 8 s.
  EXPECT_FALSE(times_uniform(snapshot, 0, Effort::seconds));
  // After 4 s it is at 1/4; the lane at 1/8.
  EXPECT_NEAR(*times_uniform(snapshot, 1, Effort::seconds), 2.0, 1e-12);
}

TEST(EffortChart, BetweenMeasuredPointsTheBaselineIsStraightInLogarithms) {
  const Snapshot snapshot = example();
  for (const double seconds : {1.0, 1.5, 3.7, 8.0}) {
    EXPECT_NEAR(*baseline_error(snapshot, Effort::seconds, seconds), 1.0 / seconds, 1e-9);
  }
  EXPECT_FALSE(baseline_error(snapshot, Effort::seconds, 0.5)) << "before its first pass";
  EXPECT_FALSE(baseline_error(snapshot, Effort::seconds, 8.1)) << "beyond its last";
  Snapshot other = snapshot;
  other.metric = MetricId::psnr;
  EXPECT_FALSE(times_uniform(other, 1, Effort::seconds)) << "a ratio of decibels means nothing";
}

TEST(EffortChart, ErrorsThatNoLogarithmHasAreLeftOut) {
  Snapshot snapshot = example();
  snapshot.lanes[0].history[1].truth.error = 0.0;
  snapshot.lanes[0].history[2].truth.error = INFINITY;
  snapshot.lanes[0].history[3].truth.error = std::nan("");
  const Chart chart = effort_chart(snapshot, against(Effort::seconds));
  EXPECT_EQ(line_of(chart, 0).points.size(), 5u);
}

}  // namespace
}  // namespace quartet
