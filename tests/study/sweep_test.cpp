#include "renderer/study/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "renderer/adaptive/effort.h"
#include "renderer/base/interval.h"
#include "renderer/scene/load_scene.h"
#include "renderer/study/calibrate.h"
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
  plan.twins = Twins::none;
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
        EXPECT_EQ(run.lane, (SweepLane{scaled_thresholds(settings, factor), factor, false}));
      }
    }
  }
}

TEST(Sweep, ARunIsThatOfALabAlone) {
  const SweepRun& run = small_result().runs[10];
  const SampleWorld world = noisy_world();
  Experiment alone(world.source(run.seed), swept_width, swept_height, {}, world.reference);
  const auto end = alone
                       .run({.settings = run.lane.settings,
                             .stop = small_plan().stop,
                             .metrics = small_plan().metrics})
                       ->back();
  EXPECT_EQ(end.record.samples, run.end.record.samples);
  EXPECT_EQ(end.values, run.end.values);
}

TEST(SweepLanes, TwinsComeBehindTheirLanesAndOnlyWhereSomethingDecides) {
  SweepPlan plan = small_plan();
  plan.lane_settings = {default_settings(EstimatorId::kl),
                        default_settings(EstimatorId::uniform_clamp),
                        default_settings(EstimatorId::contrast)};
  plan.lane_settings[2].mode = SampleMode::unbiased;
  const auto found = [&](Twins twins) {
    plan.twins = twins;
    std::string text;
    for (const SweepLane& lane : sweep_lanes(plan)) {
      EXPECT_EQ(lane.settings.mode, lane.twin || lane.settings.estimator == EstimatorId::contrast
                                        ? SampleMode::unbiased
                                        : SampleMode::reuse);
      text += std::string(estimator(lane.settings.estimator).id) + (lane.twin ? "~" : " ") +
              (lane.factor < 1.0   ? "low "
               : lane.factor > 1.0 ? "high "
                                   : "1 ");
    }
    return text;
  };
  const std::string rest = "uniform-clamp 1 contrast low contrast 1 contrast high ";
  EXPECT_EQ(found(Twins::none), "kl low kl 1 kl high " + rest);
  EXPECT_EQ(found(Twins::at_defaults), "kl low kl 1 kl high kl~1 " + rest);
  EXPECT_EQ(found(Twins::at_all), "kl low kl 1 kl high kl~low kl~1 kl~high " + rest);
}

TEST(Sweep, ATwinIsTheLaneInModeUnbiasedWithItsPilotCharged) {
  SampleWorld world = noisy_world();
  world.pilot = [source = world.source](std::uint64_t seed) { return source(seed + 1000); };
  SweepPlan plan = small_plan();
  plan.lane_settings = {default_settings(EstimatorId::kl)};
  plan.thresholds = 1;
  plan.low = plan.high = 1.0;
  plan.twins = Twins::at_all;
  plan.seeds = 1;
  plan.stop = {.passes = 4};
  const SweepResult result = *run_sweep(world, plan, {}, {});
  ASSERT_EQ(result.runs.size(), 2u);
  EXPECT_FALSE(result.runs[0].lane.twin);
  ASSERT_TRUE(result.runs[1].lane.twin);
  const PassRecord& twin = result.runs[1].end.record;
  EXPECT_EQ(twin.samples, 2 * twin.pilot_samples) << "as many shown as the pilot took";
  EXPECT_EQ(result.runs[0].end.record.pilot_samples, 0u);
  LaneSettings unbiased = plan.lane_settings[0];
  unbiased.mode = SampleMode::unbiased;
  Experiment alone = make_experiment(world, world.first_seed);
  const auto run = alone.run({.settings = unbiased, .stop = plan.stop, .metrics = plan.metrics});
  EXPECT_EQ(run->back().values, result.runs[1].end.values);
  EXPECT_EQ(run->back().record.samples, twin.samples);
}

TEST(Sweep, RunsAreMeasuredOnTheirWayAndSplitIntoBiasAndVariance) {
  const SweepResult& result = small_result();
  const SampleWorld world = noisy_world();
  const Metric& relmse = metric(MetricId::relmse);
  EXPECT_EQ(parts_metric(small_plan()), &relmse);
  ASSERT_EQ(result.parts.size(), 6u);
  for (std::size_t line = 0; line < 6; ++line) {
    std::map<std::uint32_t, std::vector<RadianceImage>> pictures;
    std::vector<RadianceImage> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const SweepRun& run = result.runs[6 * k + line];
      Experiment alone = make_experiment(world, run.seed);
      RunPlan plan{.settings = run.lane.settings,
                   .stop = small_plan().stop,
                   .metrics = {MetricId::relmse},
                   .measure_at = MeasureAt::every_pass};
      plan.each_picture = [&](std::uint32_t pass, const RadianceImage& image) {
        pictures[pass].push_back(image);
      };
      const auto passes = *alone.run(plan);
      ends.push_back(alone.lane().film().image());
      ASSERT_FALSE(run.way.empty());
      for (const Measurement& way : run.way) {
        const std::uint32_t pass = way.record.pass;
        EXPECT_TRUE(pass == 1 || pass == 2 || pass == 3 || pass == 4) << pass;
        EXPECT_EQ(way.values, passes[pass - 1].values) << "the first metric alone";
        EXPECT_EQ(way.energy, passes[pass - 1].energy);
        EXPECT_EQ(way.record.samples, passes[pass - 1].record.samples);
      }
    }
    const auto expect_parts = [&](const ErrorParts& parts, const std::vector<RadianceImage>& of) {
      ASSERT_EQ(of.size(), 3u);
      ErrorSums sums;
      double mean = 0.0;
      for (const RadianceImage& image : of) {
        sums.add(relmse.errors(image, *world.reference));
        mean += relmse.compute(image, *world.reference) / 3.0;
      }
      EXPECT_EQ(parts.variance, sums.parts().variance);
      EXPECT_EQ(parts.squared_bias, sums.parts().squared_bias);
      EXPECT_NEAR(parts.variance + parts.squared_bias, mean, 1e-6 * mean);
    };
    expect_parts(result.parts[line].end, ends);
    for (const std::uint32_t pass : {1, 2, 3, 4}) {
      ASSERT_TRUE(result.parts[line].way.contains(pass)) << pass;
      expect_parts(result.parts[line].way.at(pass), pictures[pass]);
    }
  }
  EXPECT_FALSE(result.parts_at_ends_only);
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
  EXPECT_TRUE(result.parts_at_ends_only) << "a picture of each of ten passes takes more";
  EXPECT_TRUE(result.parts[0].way.empty());
  EXPECT_EQ(result.parts[0].end.variance, small_result().parts[0].end.variance);
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

}  // namespace
}  // namespace quartet
