#include "renderer/measure/bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "renderer/measure/interval.h"
#include "renderer/scene/load_scene.h"

namespace quartet {
namespace {

std::vector<BiasRuns> measure(const char* scene, EstimatorId id, AllocationId kind, float threshold,
                              std::uint32_t frames, std::uint32_t seeds) {
  auto made = std::make_shared<const TraceScene>(open_scene(scene));
  RenderSettings settings = default_settings(made->scene());
  SamplingPolicy policy = default_policy(id);
  policy.allocation.kind = kind;
  policy.thresholds = {threshold, threshold, threshold};
  policy.max_spp = 64;
  double last = 0.0;
  std::vector<BiasRuns> runs =
      measure_bias(made, settings, std::span(&policy, 1), frames, seeds, {}, [&](double done) {
        EXPECT_GE(done, last);
        last = done;
      });
  EXPECT_DOUBLE_EQ(last, 1.0);
  return runs;
}

// Levels of 1e-4 a test, four tests: false alarms 4e-4 over random seeds; these are fixed.
TEST(Bias, OfReuseIsFoundAndModeUnbiasedHasNone) {
  for (const AllocationId kind : {AllocationId::batch, AllocationId::vote}) {
    const std::vector<BiasRuns> runs =
        measure("synthetic:bernoulli", EstimatorId::chi2, kind, 0.01f, 8, 8);
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs[0].policy.use, SampleUse::reuse);
    EXPECT_LT(mean_p(runs[0].energy, 0.0), 1e-4);
    EXPECT_LT(mean_interval(runs[0].energy, 1e-4).high, 0.0);
    EXPECT_EQ(runs[1].policy.use, SampleUse::unbiased);
    EXPECT_GT(mean_p(runs[1].energy, 0.0), 1e-4);
  }
}

TEST(Bias, OfWhatDecidesNothingIsExactlyZero) {
  // No error is above this threshold: both modes are uniform sampling, of the same samples.
  const std::vector<BiasRuns> runs =
      measure("synthetic:log-normal", EstimatorId::kl, AllocationId::vote, 1e30f, 5, 2);
  for (const BiasRuns& each : runs) {
    for (const double energy : each.energy) {
      EXPECT_EQ(energy, 0.0);
    }
    for (const float difference : each.difference.pixels()) {
      EXPECT_EQ(difference, 0.0f);
    }
    EXPECT_EQ(each.mean_spp.front(), each.policy.use == SampleUse::reuse ? 5.0 : 10.0);
    // Variance e − 1 over five samples, in 18 432 numbers of two seeds each with a heavy tail.
    EXPECT_NEAR(each.noise, (std::exp(1.0) - 1.0) / 5.0, 0.06);
  }
  EXPECT_GT(price_of_unbiasedness(runs[0], runs[1]), 0.0);
}

TEST(Bias, EndsEarlyIfAskedTo) {
  auto scene = std::make_shared<const TraceScene>(open_scene("synthetic:bernoulli"));
  const SamplingPolicy policy = default_policy(EstimatorId::kl);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(measure_bias(
                  scene, default_settings(scene->scene()), std::span(&policy, 1), 3, 2, {},
                  [](double) {}, stop.get_token())
                  .empty());
}

}  // namespace
}  // namespace quartet
