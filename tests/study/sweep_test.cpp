#include "renderer/study/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "renderer/adaptive/effort.h"
#include "renderer/base/interval.h"
#include "renderer/scene/load_scene.h"
#include "renderer/study/calibrate.h"
#include "renderer/view/sweep_charts.h"
#include "tests/study/noisy_source.h"

namespace quartet {
namespace {

constexpr int swept_width = 48;
constexpr int swept_height = 32;

SampleWorld noisy_world() {
  SampleWorld world;
  world.width = swept_width;
  world.height = swept_height;
  world.first_seed = 5;
  world.reference =
      std::make_shared<const RadianceImage>(test::noisy_truth(swept_width, swept_height));
  world.source = [](std::uint64_t seed) -> SampleSource {
    // Seeds are far apart in one endless row of samples.
    return [seed, source = test::noisy_source(swept_width)](int x, int y, std::uint32_t first,
                                                            std::span<glm::vec3> radiance) {
      source(x, y, first + std::uint32_t(seed) * 100'000u, radiance);
    };
  };
  return world;
}

SweepPlan small_plan() {
  SweepPlan plan;
  plan.lane_settings = {default_settings(EstimatorId::kl), default_settings(EstimatorId::contrast)};
  plan.thresholds = 3;
  plan.seeds = 3;
  plan.stop = {.passes = 6, .spp = 20.0};
  plan.metrics = {MetricId::relmse, MetricId::mse};
  return plan;
}

const SweepResult& small_result() {
  static const SweepResult result = *run_sweep(noisy_world(), small_plan(), {}, {});
  return result;
}

TEST(SweepFactors, AreGeometricWithTheDefaultAmongThem) {
  SweepPlan plan;
  plan.thresholds = 3;
  EXPECT_EQ(sweep_factors(plan), (std::vector<double>{0.1, 1.0, 10.0})) << "1 is one of them";
  plan.thresholds = 2;
  EXPECT_EQ(sweep_factors(plan), (std::vector<double>{0.1, 1.0, 10.0})) << "1 is added";
  plan.thresholds = 1;
  plan.low = 1.0;
  EXPECT_EQ(sweep_factors(plan), std::vector<double>{1.0});
  plan.thresholds = 8;
  plan.low = 0.25;
  plan.high = 4.0;
  const std::vector<double> factors = sweep_factors(plan);
  ASSERT_EQ(factors.size(), 9u);
  EXPECT_TRUE(std::ranges::is_sorted(factors));
  EXPECT_NEAR(factors[1] / factors[0], factors[8] / factors[7], 1e-12);
  plan.low = 2.0;
  EXPECT_EQ(sweep_factors(plan).front(), 1.0) << "even outside of the range";
}

TEST(Sweep, HasEveryLaneFactorAndSeedOnce) {
  const SweepResult& result = small_result();
  ASSERT_EQ(result.runs.size(), 2u * 3u * 3u);
  ASSERT_EQ(result.uniform.size(), 3u);
  std::size_t i = 0;
  for (std::uint64_t seed = 5; seed < 8; ++seed) {
    for (const LaneSettings& settings : small_plan().lane_settings) {
      for (const double factor : {0.1, 1.0, 10.0}) {
        const SweepRun& run = result.runs[i++];
        EXPECT_EQ(run.seed, seed);
        EXPECT_EQ(run.factor, factor);
        EXPECT_EQ(run.settings, scaled_thresholds(settings, factor));
      }
    }
  }
}

TEST(Sweep, ARunIsThatOfALabAlone) {
  const SweepRun& run = small_result().runs[10];
  const SampleWorld world = noisy_world();
  Experiment alone(world.source(run.seed), swept_width, swept_height, {}, world.reference);
  const auto end = alone
                       .run({.settings = run.settings,
                             .stop = small_plan().stop,
                             .metrics = small_plan().metrics})
                       ->back();
  EXPECT_EQ(end.record.samples, run.end.record.samples);
  EXPECT_EQ(end.values, run.end.values);
}

TEST(Sweep, TheBaselineIsMeasuredAroundTheSamplesOfEachRun) {
  const SweepResult& result = small_result();
  for (std::size_t k = 0; k < result.uniform.size(); ++k) {
    const std::vector<Measurement>& uniform = result.uniform[k];
    EXPECT_EQ(uniform.front().record.pass, 1u);
    for (std::size_t i = 0; i < 6; ++i) {
      const double spp = result.runs[6 * k + i].end.mean_spp;
      const auto after = std::ranges::lower_bound(uniform, spp, {}, &Measurement::mean_spp);
      ASSERT_NE(after, uniform.end());
      EXPECT_LT(after->mean_spp - spp, 1.0) << "a pass is a sample a pixel";
      if (after != uniform.begin()) {
        EXPECT_LE(spp - (after - 1)->mean_spp, 1.0);
      }
    }
  }
}

TEST(Sweep, TracesLittleMoreThanItsDearestRun) {
  const SweepResult& result = small_result();
  std::uint64_t used = 0;
  for (const SweepRun& run : result.runs) {
    used += run.end.record.samples;
  }
  for (const std::vector<Measurement>& run : result.uniform) {
    used += run.back().record.samples;
  }
  EXPECT_GT(result.samples_used, used) << "a run of the baseline finds out how far it has to go";
  EXPECT_LT(result.samples_traced, used / 3);
  EXPECT_FALSE(result.partial);
}

TEST(Sweep, ShortOfMemoryItTracesAgainWithTheSameResult) {
  SampleWorld world = noisy_world();
  world.lab.memory = 60'000;
  const SweepResult result = *run_sweep(world, small_plan(), {}, {});
  EXPECT_TRUE(result.partial);
  EXPECT_GT(result.samples_traced, small_result().samples_traced);
  ASSERT_EQ(result.runs.size(), small_result().runs.size());
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const SweepRun& a = result.runs[i];
    const SweepRun& b = small_result().runs[i];
    EXPECT_EQ(a.end.values, b.end.values);
    EXPECT_EQ(a.end.record.samples, b.end.record.samples);
    EXPECT_EQ(a.quality.rank_correlation, b.quality.rank_correlation);
    EXPECT_EQ(a.oracle_distance, b.oracle_distance);
  }
}

TEST(Sweep, ProgressRisesAndStops) {
  double last = -1.0;
  run_sweep(noisy_world(), small_plan(), {}, [&](double done, std::string_view what) {
    EXPECT_GE(done, last - 1e-9);
    EXPECT_LE(done, 1.0 + 1e-9);
    EXPECT_FALSE(what.empty());
    last = done;
  });
  EXPECT_GT(last, 0.9);
  std::stop_source stop;
  EXPECT_FALSE(run_sweep(noisy_world(), small_plan(), stop.get_token(),
                         [&](double, std::string_view) { stop.request_stop(); }));
}

TEST(SweepPoints, AreMediansOverSeedsWithTheirRange) {
  const SweepResult& result = small_result();
  const auto points = sweep_points(result, small_plan(), 1);
  ASSERT_EQ(points.size(), 6u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<double> errors;
    for (std::size_t k = 0; k < 3; ++k) {
      errors.push_back(result.runs[6 * k + i].end.values[1]);
    }
    std::ranges::sort(errors);
    EXPECT_EQ(points[i].error_low, errors[0]);
    EXPECT_EQ(points[i].error, errors[1]);
    EXPECT_EQ(points[i].error_high, errors[2]);
    EXPECT_GT(points[i].against_uniform[std::size_t(Effort::mean_spp)], 0.0);
  }
  // Higher thresholds, fewer samples.
  EXPECT_GT(points[0].mean_spp, points[1].mean_spp);
  EXPECT_GE(points[1].mean_spp, points[2].mean_spp);
}

TEST(SweepPoints, AgainstUniformIsTheRatioAtEqualEffort) {
  SweepPlan plan = small_plan();
  plan.lane_settings = {default_settings(EstimatorId::kl)};
  plan.thresholds = 1;
  plan.low = 1.0;
  plan.metrics = {MetricId::mse};
  SweepResult result;
  result.first_seed = 9;
  const auto measured = [](double seconds, double error) {
    Measurement measurement;
    measurement.record.seconds = seconds;
    measurement.mean_spp = 10.0 * seconds;
    measurement.mean_rays = 20.0 * seconds * seconds;
    measurement.values = {error};
    return measurement;
  };
  for (const double noise : {1.0, 2.0, 4.0}) {
    // Uniform: noise / seconds. The other: half of that, after 3 seconds.
    result.uniform.push_back({measured(1.0, noise), measured(4.0, noise / 4.0)});
    SweepRun run{.settings = plan.lane_settings[0], .seed = 9 + result.runs.size()};
    run.end = measured(3.0, 0.5 * noise / 3.0);
    result.runs.push_back(run);
  }
  const auto points = sweep_points(result, plan, 0);
  ASSERT_EQ(points.size(), 1u);
  for (const double ratio : points[0].against_uniform) {
    EXPECT_NEAR(ratio, 0.5, 1e-12);
  }
  EXPECT_NEAR(points[0].error, 1.0 / 3.0, 1e-12);
}

TEST(SweepPoints, OfThreeSeedsByHand) {
  SweepPlan plan = small_plan();
  plan.lane_settings = {default_settings(EstimatorId::kl)};
  plan.thresholds = 1;
  plan.low = 1.0;
  plan.metrics = {MetricId::mse, MetricId::rmse, MetricId::psnr};
  SweepResult result;
  result.first_seed = 100;
  const auto measured = [](double seconds, double spp, double mse, double rmse, double psnr) {
    Measurement measurement;
    measurement.record.seconds = seconds;
    measurement.mean_spp = spp;
    measurement.values = {mse, rmse, psnr};
    return measurement;
  };
  const auto at_pass = [](std::uint32_t pass, Measurement measurement) {
    measurement.record.pass = pass;
    return measurement;
  };
  // Uniform sampling at passes 2 and 4; the second seed was measured once more.
  result.uniform = {
      {at_pass(2, measured(1, 10, 8, 80, 30)), at_pass(4, measured(4, 40, 2, 40, 36))},
      {at_pass(2, measured(1.5, 11, 6, 60, 31)),
       at_pass(3, measured(3, 22, 3, 60 / std::sqrt(2), 34)),
       at_pass(4, measured(6, 44, 1.5, 30, 37))},
      {at_pass(2, measured(3, 30, 4, 50, 33)), at_pass(4, measured(5, 50, 1.25, 25, 38))}};
  const auto add = [&](std::uint64_t seed, const Measurement& end) {
    SweepRun run{.settings = plan.lane_settings[0], .seed = seed};
    run.end = end;
    result.runs.push_back(run);
  };
  add(100, measured(2, 20, 1, 100, 35));
  add(101, measured(3, 28, 6, 15, 32));
  add(102, measured(4, 90, 0.5, 50, 40));

  const auto mse = sweep_points(result, plan, 0);
  ASSERT_EQ(mse.size(), 1u);
  EXPECT_EQ(mse[0].settings, plan.lane_settings[0]);
  EXPECT_EQ(mse[0].factor, 1.0);
  EXPECT_EQ(mse[0].seconds, 3.0);
  EXPECT_EQ(mse[0].mean_spp, 28.0) << "the mean is 46";
  EXPECT_EQ(mse[0].error, 1.0);
  EXPECT_EQ(mse[0].error_low, 0.5);
  EXPECT_EQ(mse[0].error_high, 6.0);
  // Uniform sampling: 8/s, so 4 after 2 s; 9/s, so 3 after 3 s; 4 (s/3)^-2.2764 between 3 and 5 s,
  // so 2.0780 after 4 s. Ratios: 1/4, 2 and 0.2406.
  EXPECT_NEAR(mse[0].against_uniform[std::size_t(Effort::seconds)], 0.25, 1e-12);
  const auto rmse = sweep_points(result, plan, 1);
  EXPECT_EQ(rmse[0].error, 50.0);
  EXPECT_EQ(rmse[0].error_low, 15.0);
  EXPECT_EQ(rmse[0].error_high, 100.0);
  // 80 falls to 40 as 1/√s: 80 / √2 after 2 s. 60 to 30 too: 60 / √2 after 3 s. 50 falls to 25 as
  // s^-1.357 from 3 to 5 s: 33.84 after 4 s. Ratios: 1.77, 0.35 and 1.48.
  EXPECT_NEAR(rmse[0].against_uniform[std::size_t(Effort::seconds)],
              std::pow(4.0 / 3.0, std::log(2.0) / std::log(5.0 / 3.0)), 1e-9);
  const auto psnr = sweep_points(result, plan, 2);
  EXPECT_EQ(psnr[0].error, 35.0);
  EXPECT_TRUE(std::isnan(psnr[0].against_uniform[0])) << "of decibels there is no ratio";

  const auto uniform = uniform_points(result, 0);
  ASSERT_EQ(uniform.size(), 2u) << "the passes that all seeds have";
  EXPECT_EQ(uniform[0].settings.estimator, EstimatorId::uniform);
  EXPECT_EQ(uniform[0].seconds, 1.5);
  EXPECT_EQ(uniform[0].mean_spp, 11.0);
  EXPECT_EQ(uniform[0].error, 6.0);
  EXPECT_EQ(uniform[0].error_low, 4.0);
  EXPECT_EQ(uniform[0].error_high, 8.0);
  EXPECT_EQ(uniform[0].against_uniform[0], 1.0);
  EXPECT_EQ(uniform[1].seconds, 5.0);
  EXPECT_EQ(uniform[1].mean_spp, 44.0);
  EXPECT_EQ(uniform[1].error, 1.5);
  EXPECT_EQ(uniform[1].error_low, 1.25);
  EXPECT_EQ(uniform[1].error_high, 2.0);

  const SweepSummary summary = summarize(result, plan, 0, 0.125);
  EXPECT_EQ(summary.metric, MetricId::mse);
  EXPECT_EQ(summary.seeds, 3u);
  EXPECT_EQ(summary.noise_floor, 0.125);
  ASSERT_EQ(summary.points.size(), 1u);
  EXPECT_EQ(summary.points[0].seconds, 3.0);
  ASSERT_EQ(summary.uniform.size(), 2u);
  // By rising time: uniform after 1.5 s, kl after 3 s; uniform after 5 s is worse than that.
  ASSERT_EQ(summary.front.size(), 2u);
  EXPECT_EQ(summary.front[0].error, 6.0);
  EXPECT_EQ(summary.front[1].error, 1.0);
}

TEST(Sweep, EachSeedIsUsed) {
  const SweepResult& result = small_result();
  for (std::size_t k = 1; k < 3; ++k) {
    EXPECT_NE(result.uniform[k].back().values, result.uniform[k - 1].back().values);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NE(result.runs[6 * k + i].end.values, result.runs[6 * (k - 1) + i].end.values) << i;
    }
  }
  // The tracer's world gives seed k what a lab with that seed has.
  const auto scene = std::make_shared<const TraceScene>(open_scene("synthetic:log-normal"));
  RenderSettings settings = default_settings(scene->scene());
  settings.seed = 3;
  const SampleWorld world = sample_world(scene, settings, {}, nullptr);
  EXPECT_EQ(world.first_seed, 3u);
  const auto first_of = [](const SampleSource& source) {
    glm::vec3 sample;
    source(5, 7, 0, std::span(&sample, 1));
    return sample;
  };
  for (const std::uint64_t seed : {3, 4}) {
    RenderSettings own = settings;
    own.seed = seed;
    EXPECT_EQ(first_of(world.source(seed)), first_of(sample_source(scene, own)));
    EXPECT_EQ(first_of(world.pilot(seed)), first_of(pilot_source(scene, own)));
    EXPECT_NE(first_of(world.pilot(seed)), first_of(world.source(seed)));
  }
  EXPECT_NE(first_of(world.source(3)), first_of(world.source(4)));
  EXPECT_NE(first_of(world.pilot(3)), first_of(world.pilot(4)));
}

SweepPoint point_at(double seconds, double error) {
  SweepPoint point;
  point.seconds = seconds;
  point.error = error;
  return point;
}

TEST(ParetoFront, HoldsWhatNothingBeatsInBoth) {
  const std::vector<SweepPoint> points{point_at(3, 3), point_at(1, 9), point_at(2, 9.5),
                                       point_at(4, 3), point_at(5, 1), point_at(1, 12)};
  const auto front = pareto_front(points, false);
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].error, 9);
  EXPECT_EQ(front[1].error, 3);
  EXPECT_EQ(front[1].seconds, 3);
  EXPECT_EQ(front[2].error, 1);
  // By the definition, for every pair.
  for (const SweepPoint& point : points) {
    const bool beaten = std::ranges::any_of(points, [&](const SweepPoint& other) {
      return other.seconds <= point.seconds && other.error <= point.error &&
             (other.seconds < point.seconds || other.error < point.error);
    });
    const bool in_front = std::ranges::any_of(front, [&](const SweepPoint& other) {
      return other.seconds == point.seconds && other.error == point.error;
    });
    EXPECT_NE(beaten, in_front);
  }
  EXPECT_EQ(pareto_front(points, true).size(), 1u) << "the best comes first";
}

TEST(Median, OfOddAndEvenNumbers) {
  EXPECT_EQ(median({3, 1, 2}), 2.0);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_TRUE(std::isnan(median({1, std::numeric_limits<double>::quiet_NaN(), 2})));
}

TEST(SweepCharts, HoldEveryCurveTheBaselineTheDefaultsAndTheFloor) {
  const SweepSummary summary = summarize(small_result(), small_plan(), 0, 1e-5);
  const std::vector<Chart> charts = sweep_charts(summary);
  ASSERT_EQ(charts.size(), 2u) << "no samples were traced, so that there are no rays to chart";
  for (const Chart& chart : charts) {
    EXPECT_EQ(chart.x.spacing, Spacing::logarithmic);
    EXPECT_NE(chart.y.label.find(metric(MetricId::relmse).label), std::string::npos);
    for (const LaneSettings& settings : small_plan().lane_settings) {
      const auto line =
          std::ranges::find(chart.lines, estimator(settings.estimator).label, &Line::label);
      ASSERT_NE(line, chart.lines.end());
      EXPECT_EQ(line->points.size(), 3u);
      EXPECT_TRUE(line->dots);
      for (const glm::dvec2& point : line->points) {
        EXPECT_GE(axis_position(chart.x, point.x), 0.0);
        EXPECT_LE(axis_position(chart.x, point.x), 1.0);
        EXPECT_GE(axis_position(chart.y, point.y), 0.0);
        EXPECT_LE(axis_position(chart.y, point.y), 1.0);
      }
    }
    EXPECT_EQ(std::ranges::count(chart.marks, "default threshold", &PointMark::label), 2);
    EXPECT_EQ(chart.bands.size(), 2u);
    ASSERT_EQ(chart.levels.size(), 1u);
    EXPECT_EQ(chart.levels[0].value, 1e-5);
    const auto baseline = std::ranges::find(chart.lines, Dash::dashed, &Line::dash);
    ASSERT_NE(baseline, chart.lines.end());
    EXPECT_EQ(baseline->points.size(), uniform_points(small_result(), 0).size()) << "as measured";
  }
}

TEST(SweepCharts, OfTracedSamplesHaveOneAgainstRays) {
  SweepResult result = small_result();
  for (SweepRun& run : result.runs) {
    run.end.mean_rays = 7.0 * run.end.mean_spp;
  }
  for (std::vector<Measurement>& run : result.uniform) {
    for (Measurement& measurement : run) {
      measurement.mean_rays = 7.0 * measurement.mean_spp;
    }
  }
  const std::vector<Chart> charts = sweep_charts(summarize(result, small_plan(), 0, 1e-5));
  ASSERT_EQ(charts.size(), 3u);
  ASSERT_EQ(charts[1].lines.size(), charts[2].lines.size());
  for (std::size_t i = 0; i < charts[1].lines.size(); ++i) {
    const Line& rays = charts[1].lines[i];
    const Line& samples = charts[2].lines[i];
    ASSERT_EQ(rays.points.size(), samples.points.size());
    for (std::size_t k = 0; k < rays.points.size(); ++k) {
      EXPECT_NEAR(rays.points[k].x / samples.points[k].x, 7.0, 1e-9);
      EXPECT_NEAR(rays.points[k].y / samples.points[k].y, 1.0, 1e-9);
    }
  }
}

TEST(CalibrationChart, HasALineAnEstimator) {
  const Chart chart = calibration_chart(small_result());
  ASSERT_EQ(chart.lines.size(), 2u);
  for (const Line& line : chart.lines) {
    EXPECT_GT(line.points.size(), 3u);
  }
}

}  // namespace
}  // namespace quartet
