#include "renderer/study/versus.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/study/noisy_source.h"

namespace quartet {
namespace {

Measurement versus_pass(double spp, double error, double energy) {
  Measurement pass;
  pass.record.pass = std::uint32_t(spp);
  pass.mean_spp = spp;
  pass.values = {error};
  pass.energy = energy;
  return pass;
}

/// Errors of A are `a` / spp, those of B `b` / spp².
VersusSeed falling_seed(double a, double b) {
  VersusSeed seed;
  for (const double spp : {1.0, 2.0, 4.0, 8.0, 16.0}) {
    seed.runs[0].passes.push_back(versus_pass(spp, a / spp, -1.0 / spp));
    seed.runs[1].passes.push_back(versus_pass(spp, b / (spp * spp), 0.0));
  }
  return seed;
}

TEST(Versus, RatiosAreGeometricMeansOverPairedSeeds) {
  VersusResult result;
  for (const double common : {1.0, 10.0, 100.0}) {
    VersusSeed seed;
    seed.runs[0].errors = {common * 2.0};
    seed.runs[1].errors = {common};
    result.seeds.push_back(seed);
  }
  const Interval same = error_ratio(result, 0, 0.05);
  EXPECT_NEAR(same.mean, 2.0, 1e-12);
  EXPECT_NEAR(same.low, 2.0, 1e-9) << "what seeds have in common does not widen it";
  result.seeds[0].runs[0].errors = {1.0};
  result.seeds[1].runs[0].errors = {40.0};
  // Logarithms of the ratios: ln 1, ln 4, ln 2; their mean is ln 2, their deviation ln 2.
  const Interval wide = error_ratio(result, 0, 0.05);
  EXPECT_NEAR(wide.mean, 2.0, 1e-12);
  const double half = student_quantile(0.05, 2) * std::log(2.0) / std::sqrt(3.0);
  EXPECT_NEAR(std::log(wide.high / wide.mean), half, 1e-9);
}

TEST(Versus, FindsWhereTheLanesCross) {
  VersusPlan plan;
  plan.metrics = {MetricId::mse};
  VersusResult result;
  // a/n = b/n² where n = b/a: at 5 in the geometric mean.
  result.seeds = {falling_seed(1.0, 4.0), falling_seed(2.0, 12.5)};
  const auto effort = crossing(result, plan, 0);
  ASSERT_TRUE(effort);
  EXPECT_NEAR(*effort, 5.0, 0.05);
  result.seeds = {falling_seed(1.0, 400.0)};
  EXPECT_FALSE(crossing(result, plan, 0)) << "not within what was run";
}

TEST(Versus, ComparesAtTheGoalBetweenPasses) {
  SampleWorld world;
  world.width = 40;
  world.height = 16;
  world.reference =
      std::make_shared<const RadianceImage>(test::noisy_truth(world.width, world.height));
  world.source = [](std::uint64_t seed) -> SampleSource {
    return [seed, source = test::noisy_source(40)](int x, int y, std::uint32_t first,
                                                   std::span<glm::vec3> radiance) {
      source(x, y, first + std::uint32_t(seed) * 100'000u, radiance);
    };
  };
  VersusPlan plan;
  plan.lanes = {default_settings(EstimatorId::kl), default_settings(EstimatorId::uniform)};
  plan.goal = 9.5;
  plan.seeds = 4;
  plan.metrics = {MetricId::mse, MetricId::relmse};
  const VersusResult result = *run_versus(world, plan, {}, {});
  ASSERT_EQ(result.seeds.size(), 4u);
  for (const VersusSeed& seed : result.seeds) {
    EXPECT_LE(seed.effort, plan.goal);
    // Uniform sampling at 9.5 is between its passes 9 and 10, if kl goes as far.
    const auto& uniform = seed.runs[1];
    ASSERT_EQ(uniform.passes.size(), 10u);
    const auto [low, high] = std::minmax(uniform.passes[8].values[0], uniform.passes[9].values[0]);
    EXPECT_GE(uniform.errors[0], low);
    EXPECT_LE(uniform.errors[0], high);
  }
  for (const VersusSeed& seed : result.seeds) {
    const VersusRun& uniform = seed.runs[1];
    EXPECT_GT(seed.effort, 9.0);
    const double low = uniform.passes[8].energy;
    const double high = uniform.passes[9].energy;
    EXPECT_NEAR(uniform.energy, std::lerp(low, high, seed.effort - 9.0), 1e-12);
  }
  // Of uniform sampling, which has no bias, all of the error is variance. With 4 seeds and 640
  // pixels the bias² is known to some 5 % of the variance; this fails by chance in under one of
  // 10^4 seeds.
  double mse = 0.0;
  for (const VersusSeed& seed : result.seeds) {
    mse += seed.runs[1].passes.back().values[0] / 4.0;
  }
  const ErrorParts& parts = result.parts[1];
  EXPECT_NEAR(parts.squared_bias + parts.variance, mse, 1e-6 * mse);
  EXPECT_LT(std::abs(parts.squared_bias), 0.2 * parts.variance);
}

TEST(Versus, WhereAFirstPassTakesMoreTheOtherGoesAsFar) {
  SampleWorld world;
  world.width = 8;
  world.height = 8;
  world.reference = std::make_shared<const RadianceImage>(test::noisy_truth(8, 8));
  world.source = [](std::uint64_t) { return test::noisy_source(8); };
  VersusPlan plan;
  plan.lanes = {default_settings(EstimatorId::uniform), default_settings(EstimatorId::cycles)};
  plan.lanes[1].policy.kind = PolicyId::converge;
  plan.goal = 5.0;
  plan.seeds = 2;
  plan.metrics = {MetricId::mse};
  const VersusResult result = *run_versus(world, plan, {}, {});
  for (const VersusSeed& seed : result.seeds) {
    EXPECT_EQ(seed.effort, 16.0) << "what converge takes before its first look";
    EXPECT_EQ(seed.runs[0].passes.back().mean_spp, 16.0);
    EXPECT_EQ(seed.runs[0].errors[0], seed.runs[0].passes.back().values[0]);
  }
}

TEST(Versus, BiasAndVarianceOfAPictureThatIsTooDark) {
  // Every sample 0.5 of a truth of 1, on and off by 0.25 in turn with the seed.
  SampleWorld world;
  world.width = 4;
  world.height = 4;
  world.reference = std::make_shared<const RadianceImage>(4, 4, glm::vec3(1.0f));
  world.source = [](std::uint64_t seed) -> SampleSource {
    return [seed](int, int, std::uint32_t, std::span<glm::vec3> radiance) {
      for (glm::vec3& sample : radiance) {
        sample = glm::vec3(seed % 2 == 0 ? 0.25f : 0.75f);
      }
    };
  };
  VersusPlan plan;
  plan.lanes = {default_settings(EstimatorId::uniform), default_settings(EstimatorId::kl)};
  plan.goal = 4.0;
  plan.seeds = 4;
  plan.metrics = {MetricId::mse};
  const VersusResult result = *run_versus(world, plan, {}, {});
  // Sample variance of 0.25, 0.75, 0.25, 0.75: 1/12; bias² 0.25, less 1/48 of its own noise.
  EXPECT_NEAR(result.parts[0].variance, 1.0 / 12.0, 1e-9);
  EXPECT_NEAR(result.parts[0].squared_bias, 0.25 - 1.0 / 48.0, 1e-9);
  const Interval energy = energy_of(result, 0, 0.05);
  EXPECT_NEAR(energy.mean, -0.5, 1e-9);
}

}  // namespace
}  // namespace quartet
