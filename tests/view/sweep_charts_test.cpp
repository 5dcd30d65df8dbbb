#include "renderer/view/sweep_charts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "renderer/view/estimator_look.h"
#include "tests/study/sweep_cases.h"

namespace quartet {
namespace {

SweepSummary hand_summary(double floor = 0.004) {
  return summarize(test::hand_result(), test::hand_plan(), floor);
}

const Line& labelled(const Chart& chart, std::string_view label) {
  const auto line = std::ranges::find(chart.lines, label, &Line::label);
  EXPECT_NE(line, chart.lines.end()) << label;
  return line == chart.lines.end() ? chart.lines.front() : *line;
}

void expect_points(const Line& line, const std::vector<glm::dvec2>& expected) {
  ASSERT_EQ(line.points.size(), expected.size()) << line.label;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(line.points[i].x, expected[i].x, 1e-9) << line.label << i;
    EXPECT_NEAR(line.points[i].y, expected[i].y, 1e-9) << line.label << i;
  }
}

TEST(SweepCharts, OverviewHoldsTrajectoriesOfErrorEnergyBiasAndVariance) {
  const std::vector<Chart> charts = overview_charts(hand_summary(), Effort::rays);
  ASSERT_EQ(charts.size(), 4u);
  const std::string kl(estimator(EstimatorId::kl).label);
  const std::string clamp =
      std::string(estimator(EstimatorId::uniform_clamp).label) + ", loses light";
  EXPECT_EQ(charts[0].title, "Error");
  ASSERT_EQ(charts[0].lines.size(), 4u) << "the front, uniform sampling, kl, the clamp: no twin";
  expect_points(charts[0].lines[0], {{20, 2.0}, {40, 0.55}, {80, 0.35}, {140, 0.3}, {320, 0.125}});
  expect_points(labelled(charts[0], "uniform"), {{20, 2.0}, {80, 0.5}, {320, 0.125}});
  expect_points(labelled(charts[0], kl), {{40, 0.55}, {80, 0.35}, {140, 0.3}});
  expect_points(labelled(charts[0], clamp), {{60, 0.9}});
  EXPECT_EQ(charts[0].x.label, effort_row(Effort::rays).label);
  EXPECT_EQ(charts[0].y.label, "MSE, radiance²");
  ASSERT_EQ(charts[0].levels.size(), 1u);
  EXPECT_EQ(charts[0].levels[0].value, 0.004);

  EXPECT_EQ(charts[1].title, "Light lost or gained");
  EXPECT_EQ(charts[1].y.spacing, Spacing::linear);
  expect_points(labelled(charts[1], kl + " -5.0 %"), {{40, -2}, {80, -4}, {140, -5}});
  expect_points(labelled(charts[1], clamp + " -10.0 %"), {{60, -10}});
  EXPECT_LT(charts[1].y.max, 1.0);
  EXPECT_GT(charts[1].y.min, -6.0) << "the clamp may leave it";

  EXPECT_EQ(charts[2].title, "Bias²");
  expect_points(labelled(charts[2], kl), {{40, 0.1}, {80, 0.05}, {140, 0.2}});
  // Below 0 at the last, where it leaves the chart.
  expect_points(labelled(charts[2], "uniform"), {{20, 0.02}, {80, 0.01}, {320, -0.001}});
  EXPECT_GE(charts[2].y.min, 0.1 * 0.1 / 2.5)
      << "a tenth of the least variance, or the 1, 2, 5 below";
  EXPECT_EQ(charts[3].title, "Variance");
  expect_points(labelled(charts[3], kl), {{40, 0.45}, {80, 0.3}, {140, 0.1}});
  EXPECT_EQ(charts[2].y.min, charts[3].y.min);
  EXPECT_EQ(charts[2].y.max, charts[3].y.max);

  for (const Chart& chart : charts) {
    const Line& line = labelled(chart, &chart == &charts[1] ? kl + " -5.0 %" : kl);
    EXPECT_TRUE(line.label_at_end && line.dots);
    EXPECT_EQ(line.color, look_of(EstimatorId::kl).paper);
    EXPECT_EQ(line.shape, look_of(EstimatorId::kl).shape);
    for (const glm::dvec2& point : line.points) {
      EXPECT_GE(axis_position(chart.x, point.x), 0.0);
      EXPECT_LE(axis_position(chart.x, point.x), 1.0);
      EXPECT_GE(axis_position(chart.y, point.y), -1e-9);
      EXPECT_LE(axis_position(chart.y, point.y), 1.0 + 1e-9);
    }
  }
  // Over seconds and samples the same errors.
  expect_points(labelled(overview_charts(hand_summary(), Effort::seconds)[0], kl),
                {{1.5, 0.55}, {2.5, 0.35}, {3.5, 0.3}});
  expect_points(labelled(overview_charts(hand_summary(), Effort::mean_spp)[0], kl),
                {{2, 0.55}, {4, 0.35}, {7, 0.3}});
}

TEST(SweepCharts, EarlyPassesComeInFromTheLeft) {
  SweepSummary summary = hand_summary();
  summary.lines[0].points[0].mean_rays = 0.5;
  const std::vector<Chart> charts = overview_charts(summary, Effort::rays);
  EXPECT_GT(charts[0].x.min, 140.0 / 32.0 / 2.5);
  EXPECT_EQ(labelled(charts[0], estimator(EstimatorId::kl).label).points[0].x, 0.5);
}

TEST(SweepCharts, WithoutPartsThereAreTwo) {
  SweepSummary summary = hand_summary();
  summary.parts_metric = nullptr;
  EXPECT_EQ(overview_charts(summary, Effort::rays).size(), 2u);
  summary = hand_summary();
  summary.seeds = 1;
  EXPECT_EQ(overview_charts(summary, Effort::rays).size(), 2u);
}

TEST(SweepCharts, EachEstimatorHasASmallOneWithItsThresholdsAndTwin) {
  SweepSummary summary = hand_summary();
  SweepLine higher = summary.lines[0];
  higher.lane.factor = 10.0;
  summary.lines.insert(summary.lines.begin() + 1, higher);
  const std::vector<Chart> charts = threshold_charts(summary, Effort::rays);
  ASSERT_EQ(charts.size(), 2u);
  EXPECT_EQ(charts[0].title, estimator(EstimatorId::kl).label);
  ASSERT_EQ(charts[0].lines.size(), 5u);
  EXPECT_EQ(charts[0].lines[1].label, "uniform");
  EXPECT_FALSE(charts[0].lines[1].label_at_end) << "the legend names it once for all";
  expect_points(labelled(charts[0], "× 1"), {{40, 0.55}, {80, 0.35}, {140, 0.3}});
  EXPECT_TRUE(labelled(charts[0], "× 1").dots);
  EXPECT_FALSE(labelled(charts[0], "× 10").dots);
  const Line& twin = labelled(charts[0], "× 1, unbiased");
  expect_points(twin, {{80, 0.6}, {200, 0.4}});
  EXPECT_EQ(twin.dash, Dash::dotted);
  ASSERT_EQ(charts[0].bands.size(), 1u) << "of the default thresholds";
  EXPECT_EQ(charts[0].bands[0].label, "95 % interval over 2 seeds");
  ASSERT_EQ(charts[0].bands[0].upper.size(), 3u);
  // 0.2 and 0.4: t of one degree is 12.706, and half their distance 0.1.
  EXPECT_NEAR(charts[0].bands[0].upper[2].y, 0.3 + 1.2706205, 1e-6);
  EXPECT_NEAR(charts[0].bands[0].lower[2].y, 0.3 - 1.2706205, 1e-6);
  EXPECT_EQ(twin.color, look_of(EstimatorId::kl).paper);
  ASSERT_EQ(charts[1].lines.size(), 3u);
  EXPECT_TRUE(charts[1].lines[2].label.empty()) << "one line has nothing to be told from";
  EXPECT_EQ(charts[0].x.max, charts[1].x.max);
  EXPECT_EQ(charts[0].y.min, charts[1].y.min);
  EXPECT_EQ(charts[0].y.max, charts[1].y.max);
}

TEST(SweepCharts, OfManyThresholdsOnlySomeAreNamed) {
  SweepSummary summary = hand_summary();
  const SweepLine kl = summary.lines[0];
  summary.lines.clear();
  for (int i = -50; i <= 50; ++i) {
    summary.lines.push_back(kl);
    summary.lines.back().lane.factor = std::pow(1.1, i);
  }
  const Chart chart = threshold_charts(summary, Effort::rays).front();
  const auto named = std::ranges::count_if(
      chart.lines, [](const Line& line) { return line.label_at_end && !line.label.empty(); });
  EXPECT_GE(named, 5);
  EXPECT_LE(named, 10);
  labelled(chart, "× 1");
}

TEST(CalibrationCharts, AreOneAnEstimatorAtItsDefaults) {
  SweepResult result = test::hand_result();
  for (SweepRun& run : result.runs) {
    run.quality.calibration = {{0.5, 0.25, 7}, {2.0, 4.0, 8}};
  }
  result.runs[2].quality.calibration = {{0.125, 8.0, 7}};
  const std::vector<Chart> charts = calibration_charts(result);
  ASSERT_EQ(charts.size(), 2u) << "of the first seed, without the twin";
  EXPECT_EQ(charts[0].title, estimator(EstimatorId::kl).label);
  ASSERT_EQ(charts[0].lines.size(), 1u);
  expect_points(charts[0].lines[0], {{0.5, 0.25}, {2.0, 4.0}});
  EXPECT_EQ(charts[0].lines[0].color, look_of(EstimatorId::kl).paper);
  EXPECT_LE(charts[0].x.min, 0.125) << "axes are shared";
  EXPECT_GE(charts[0].y.max, 8.0);
}

/// WCAG 2.1: relative luminances, each with 5 % of glare.
double contrast(Rgba8 a, Rgba8 b) {
  const auto light = [](Rgba8 c) {
    const auto linear = [](std::uint8_t v) {
      const double s = v / 255.0;
      return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b) + 0.05;
  };
  return std::max(light(a), light(b)) / std::min(light(a), light(b));
}

TEST(EstimatorLook, NoTwoAreAlikeAndAllCanBeSeen) {
  constexpr Rgba8 paper{255, 255, 255};
  constexpr Rgba8 window{14, 16, 21};
  for (const Estimator& a : estimators()) {
    const EstimatorLook& look = look_of(a.key);
    EXPECT_GE(contrast(look.paper, paper), 3.0) << a.id;
    EXPECT_GE(contrast(look.screen, window), 3.0) << a.id;
    for (const Estimator& b : estimators()) {
      if (a.key == b.key) {
        continue;
      }
      const EstimatorLook& other = look_of(b.key);
      EXPECT_NE(look.paper, other.paper) << a.id << b.id;
      EXPECT_NE(look.screen, other.screen) << a.id << b.id;
      EXPECT_FALSE(look.shape == other.shape && look.dash == other.dash) << a.id << b.id;
    }
  }
}

}  // namespace
}  // namespace quartet
