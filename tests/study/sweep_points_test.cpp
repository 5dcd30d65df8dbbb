#include "renderer/study/sweep_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/study/sweep_cases.h"

namespace quartet {
namespace {

/// Of two values t is Cauchy's, and the standard error of their mean half their distance.
double half_of_two(double a, double b) {
  return std::tan(0.475 * M_PI) * 0.5 * std::abs(a - b);
}

void expect_mean_of_two(const Interval& interval, double a, double b) {
  EXPECT_NEAR(interval.mean, 0.5 * (a + b), 1e-12);
  EXPECT_NEAR(interval.low, 0.5 * (a + b) - half_of_two(a, b), 1e-6);
  EXPECT_NEAR(interval.high, 0.5 * (a + b) + half_of_two(a, b), 1e-6);
}

TEST(SweepPoints, OfTwoSeedsByHand) {
  const SweepSummary summary = summarize(test::hand_result(), test::hand_plan(), 0.125);
  EXPECT_EQ(summary.metric, MetricId::mse);
  EXPECT_EQ(summary.parts_metric, &metric(MetricId::mse));
  EXPECT_EQ(summary.seeds, 2u);
  EXPECT_EQ(summary.noise_floor, 0.125);
  EXPECT_EQ(summary.counted(), Effort::rays);
  ASSERT_EQ(summary.lines.size(), 3u);

  const SweepLine& kl = summary.lines[0];
  EXPECT_EQ(role_of(kl.lane), "method");
  ASSERT_EQ(kl.points.size(), 3u);
  EXPECT_EQ(kl.points[0].pass, 1u);
  EXPECT_EQ(kl.points[0].seconds, 1.5);
  EXPECT_EQ(kl.points[0].mean_spp, 2.0);
  EXPECT_EQ(kl.points[0].mean_rays, 40.0);
  expect_mean_of_two(kl.points[0].error, 0.5, 0.6);
  expect_mean_of_two(kl.points[0].energy, -0.02, -0.02);
  EXPECT_EQ(kl.points[0].parts.squared_bias, 0.1);
  EXPECT_EQ(kl.points[0].parts.variance, 0.45);
  EXPECT_TRUE(std::isnan(kl.points[0].against_uniform[0].mean)) << "known of ends alone";
  EXPECT_EQ(kl.points[1].pass, 2u);
  EXPECT_EQ(kl.points[1].seconds, 2.5);
  expect_mean_of_two(kl.points[1].error, 0.3, 0.4);
  EXPECT_EQ(kl.points[1].parts.variance, 0.3);
  EXPECT_EQ(kl.end().pass, 3u);
  EXPECT_EQ(kl.end().seconds, 3.5);
  EXPECT_EQ(kl.end().mean_spp, 7.0);
  expect_mean_of_two(kl.end().error, 0.2, 0.4);
  expect_mean_of_two(kl.end().energy, -0.06, -0.04);
  EXPECT_EQ(kl.end().parts.squared_bias, 0.2);
  EXPECT_EQ(kl.end().parts.variance, 0.1);
  // Uniform sampling has 1.6/6 and 2.4/8 at the effort of the ends: 3/4 and 4/3 of it.
  for (const EffortRow& effort : efforts()) {
    const Interval& ratio = kl.end().against_uniform[std::size_t(effort.key)];
    EXPECT_NEAR(ratio.mean, 1.0, 1e-9);
    EXPECT_NEAR(std::log(ratio.high), half_of_two(std::log(0.75), std::log(4.0 / 3.0)), 1e-6);
  }

  const SweepLine& twin = summary.lines[1];
  EXPECT_EQ(role_of(twin.lane), "unbiased twin, its pilot charged");
  ASSERT_EQ(twin.points.size(), 2u);
  EXPECT_EQ(twin.end().pass, 0u) << "the seeds ended after different passes";
  EXPECT_EQ(twin.end().parts.squared_bias, -0.01);
  EXPECT_NEAR(twin.end().against_uniform[std::size_t(Effort::rays)].mean,
              std::sqrt(0.4 / 0.16 * 0.4 / 0.24), 1e-9);

  const SweepLine& clamp = summary.lines[2];
  EXPECT_EQ(role_of(clamp.lane), "baseline that loses light by design");
  ASSERT_EQ(clamp.points.size(), 1u);
  EXPECT_NEAR(clamp.end().energy.mean, -0.1, 1e-12);

  EXPECT_EQ(role_of(summary.uniform.lane), "baseline");
  ASSERT_EQ(summary.uniform.points.size(), 3u);
  EXPECT_EQ(summary.uniform.points[1].pass, 4u);
  expect_mean_of_two(summary.uniform.points[1].error, 0.4, 0.6);
  EXPECT_EQ(summary.uniform.points[1].parts.squared_bias, 0.01);
  EXPECT_EQ(summary.uniform.points[1].against_uniform[0].mean, 1.0);
}

TEST(SweepPoints, OnlyPassesOfAllSeedsAreOnALine) {
  SweepResult result = test::hand_result();
  result.runs[0].way.erase(result.runs[0].way.begin());  // kl, first seed: pass 1
  result.runs[3].way[1].record.pass = 7;                 // second seed: pass 2
  result.uniform[1].erase(result.uniform[1].begin());
  const SweepSummary summary = summarize(result, test::hand_plan(), 0.0);
  ASSERT_EQ(summary.lines[0].points.size(), 1u);
  EXPECT_EQ(summary.lines[0].end().pass, 3u);
  ASSERT_EQ(summary.uniform.points.size(), 2u);
  EXPECT_EQ(summary.uniform.points[0].pass, 4u);
}

TEST(SweepPoints, OfDecibelsThereIsNoRatioAndWithoutSquaresNoParts) {
  SweepPlan plan = test::hand_plan();
  plan.metrics = {MetricId::psnr};
  SweepResult result = test::hand_result();
  result.parts.clear();
  result.uniform_parts = {};
  const SweepSummary summary = summarize(result, plan, 0.0);
  EXPECT_EQ(summary.parts_metric, nullptr);
  EXPECT_TRUE(std::isnan(summary.lines[0].end().against_uniform[0].mean));
  EXPECT_TRUE(std::isnan(summary.lines[0].end().parts.variance));
}

TEST(SweepPoints, PartsAreThoseOfTheFirstMetricThatIsAMeanOfSquares) {
  SweepPlan plan;
  plan.metrics = {MetricId::flip, MetricId::relmse_regions, MetricId::mse};
  EXPECT_EQ(parts_metric(plan), &metric(MetricId::relmse_regions));
}

TEST(SweepFront, RunsOverAllPassesButThoseOfTheOracle) {
  SweepSummary summary = summarize(test::hand_result(), test::hand_plan(), 0.0);
  const auto errors = [&] {
    std::vector<double> found;
    for (const SweepPoint& point : front_of(summary, Effort::rays)) {
      found.push_back(std::round(1e6 * point.error.mean) / 1e6);
    }
    return found;
  };
  // At 20 rays uniform sampling, at 40, 80 and 140 kl, at 320 uniform sampling again.
  EXPECT_EQ(errors(), (std::vector{2.0, 0.55, 0.35, 0.3, 0.125}));
  summary.lines[0].lane.settings.estimator = EstimatorId::oracle;
  summary.lines[1].lane.settings.estimator = EstimatorId::oracle;
  EXPECT_EQ(role_of(summary.lines[0].lane), "bound: knows the truth");
  // The clamp at 60.
  EXPECT_EQ(errors(), (std::vector{2.0, 0.9, 0.5, 0.125}));
}

SweepPoint point_at(double seconds, double error) {
  SweepPoint point;
  point.seconds = seconds;
  point.error.mean = error;
  return point;
}

TEST(ParetoFront, HoldsWhatNothingBeatsInBoth) {
  const std::vector<SweepPoint> points{point_at(3, 3), point_at(1, 9), point_at(2, 9.5),
                                       point_at(4, 3), point_at(5, 1), point_at(1, 12)};
  const auto front = pareto_front(points, Effort::seconds, false);
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].error.mean, 9);
  EXPECT_EQ(front[1].error.mean, 3);
  EXPECT_EQ(front[1].seconds, 3);
  EXPECT_EQ(front[2].error.mean, 1);
  // By the definition, for every pair.
  for (const SweepPoint& point : points) {
    const bool beaten = std::ranges::any_of(points, [&](const SweepPoint& other) {
      return other.seconds <= point.seconds && other.error.mean <= point.error.mean &&
             (other.seconds < point.seconds || other.error.mean < point.error.mean);
    });
    const bool in_front = std::ranges::any_of(front, [&](const SweepPoint& other) {
      return other.seconds == point.seconds && other.error.mean == point.error.mean;
    });
    EXPECT_NE(beaten, in_front);
  }
  EXPECT_EQ(pareto_front(points, Effort::seconds, true).size(), 1u) << "the best comes first";
}

}  // namespace
}  // namespace quartet
