#include "renderer/measure/claims.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "renderer/measure/reference_render.h"
#include "renderer/scene/load_scene.h"

namespace quartet {
namespace {

std::size_t index_of(RegionId id) {
  return std::size_t(&region(id) - regions().data());
}

/// Data in which all five findings hold by a wide margin.
ClaimData obedient_data() {
  ClaimData data;
  data.pixels.assign(regions().size(), 100);
  for (int k = 0; k < 4; ++k) {
    const double wobble = 1.0 + 0.001 * k;
    ClaimSeed seed;
    seed.lowest_correlation = 0.97 - 0.001 * k;
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      ClaimRun& run = seed.runs[c];
      run.spp.assign(regions().size(), 20.0 * wobble);
      run.share.assign(regions().size(), 1.0 / double(regions().size()));
      run.lit_spp = 30.0 * wobble;
      run.mean_spp = c == 3 ? 20.0 * wobble : 25.0 * wobble;
      const bool is_contrast = c == 0;
      run.spp[index_of(RegionId::ceiling)] = is_contrast ? 55.0 : 25.0;
      run.spp[index_of(RegionId::ball_shadow)] = is_contrast ? 50.0 : 28.0;
      run.spp[index_of(RegionId::bright_squares)] = is_contrast ? 25.0 : 40.0;
      run.spp[index_of(RegionId::dark_squares)] = 25.0;
      run.spp[index_of(RegionId::bright_borders)] = 60.0 * wobble;
      run.spp[index_of(RegionId::dark_borders)] = 59.0 * wobble;
      run.seconds = 2.0;
      run.relmse = 0.01 * wobble;
      run.uniform_relmse = 0.02;
      run.flip = 0.2;
      run.uniform_flip = 0.1 * wobble;
      run.firefly = {100, 2.5 * wobble, 1.5};
    }
    data.seeds.push_back(seed);
  }
  return data;
}

std::vector<Verdict> verdicts(const ClaimData& data) {
  std::vector<Verdict> all;
  for (const Claim& claim : judge_claims(data)) {
    all.push_back(claim.verdict);
  }
  return all;
}

template <class Change>
Verdict verdict_after(std::size_t claim, const Change& change) {
  ClaimData data = obedient_data();
  for (ClaimSeed& seed : data.seeds) {
    change(seed);
  }
  const auto all = verdicts(data);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i != claim) {
      EXPECT_EQ(all[i], Verdict::holds) << "finding " << i + 1;
    }
  }
  return all[claim];
}

TEST(Claims, HoldWhereTheyShould) {
  const std::vector<Claim> claims = judge_claims(obedient_data());
  ASSERT_EQ(claims.size(), 5u);
  for (std::size_t i = 0; i < claims.size(); ++i) {
    EXPECT_EQ(claims[i].number, int(i) + 1);
    for (const ClaimCheck& check : claims[i].checks) {
      EXPECT_EQ(check.verdict, Verdict::holds) << check.text;
    }
    EXPECT_EQ(claims[i].verdict, Verdict::holds) << claims[i].text;
  }
}

TEST(Claims, EachFailsWithItsCondition) {
  EXPECT_EQ(
      verdict_after(0, [](ClaimSeed& s) { s.runs[0].spp[index_of(RegionId::ball_shadow)] = 31.0; }),
      Verdict::does_not_hold);
  EXPECT_EQ(
      verdict_after(0, [](ClaimSeed& s) { s.runs[2].spp[index_of(RegionId::ceiling)] = 40.0; }),
      Verdict::does_not_hold);
  EXPECT_EQ(verdict_after(
                1, [](ClaimSeed& s) { s.runs[1].spp[index_of(RegionId::bright_squares)] = 26.0; }),
            Verdict::does_not_hold);
  EXPECT_EQ(verdict_after(
                1, [](ClaimSeed& s) { s.runs[0].spp[index_of(RegionId::dark_borders)] = 45.0; }),
            Verdict::does_not_hold);
  EXPECT_EQ(verdict_after(2, [](ClaimSeed& s) { s.lowest_correlation = 0.8; }),
            Verdict::does_not_hold);
  EXPECT_EQ(verdict_after(2, [](ClaimSeed& s) { s.runs[3].mean_spp = 26.0; }),
            Verdict::does_not_hold);
  EXPECT_EQ(
      verdict_after(3, [](ClaimSeed& s) { s.runs[3].spp[index_of(RegionId::red_wall)] = 33.0; }),
      Verdict::does_not_hold);
  EXPECT_EQ(verdict_after(4, [](ClaimSeed& s) { s.runs[1].firefly.nearby = 1.0; }),
            Verdict::does_not_hold);
}

TEST(Claims, AreUndecidedWhereSeedsDisagreeOrThereIsOne) {
  int k = 0;
  EXPECT_EQ(verdict_after(2, [&](ClaimSeed& s) { s.lowest_correlation = k++ % 2 ? 0.99 : 0.82; }),
            Verdict::undecided);
  ClaimData data = obedient_data();
  data.seeds.resize(1);
  for (const Verdict verdict : verdicts(data)) {
    EXPECT_EQ(verdict, Verdict::undecided);
  }
}

TEST(Claims, TheRaceIsAGeometricMean) {
  const Interval relmse = against_uniform(obedient_data(), 0, MetricId::relmse);
  EXPECT_NEAR(relmse.mean, 0.5 * std::pow(1.0 * 1.001 * 1.002 * 1.003, 0.25), 1e-12);
  EXPECT_LT(relmse.low, relmse.mean);
  EXPECT_LT(relmse.high, 1.0);
  EXPECT_GT(against_uniform(obedient_data(), 2, MetricId::flip).low, 1.0);
}

TEST(Claims, AreMeasuredOnTheReportsScene) {
  const auto scene = std::make_shared<const TraceScene>(load_scene(find_scene("cornell-checker")));
  RenderSettings settings = default_settings(scene->scene());
  settings.width = 96;
  settings.height = 54;
  ReferenceRender render(scene, [&] {
    RenderSettings other = settings;
    other.seed = reference_seed;
    return other;
  }());
  render.add(64);
  const auto reference = render.reference();
  const SampleWorld world = sample_world(
      scene, settings, {}, std::shared_ptr<const RadianceImage>(reference, &reference->image));
  const std::vector<RegionId> found = find_regions(*scene, settings);
  double last = -1.0;
  const auto data = measure_claims(world, found, 6, 2, {}, [&](double done, std::string_view) {
    EXPECT_GT(done, last);
    last = done;
  });
  ASSERT_TRUE(data);
  ASSERT_EQ(data->seeds.size(), 2u);
  EXPECT_EQ(std::accumulate(data->pixels.begin(), data->pixels.end(), std::size_t(0)), 96u * 54u);
  for (const ClaimSeed& seed : data->seeds) {
    EXPECT_GT(seed.lowest_correlation, 0.0);
    EXPECT_LE(seed.lowest_correlation, 1.0);
    for (const ClaimRun& run : seed.runs) {
      EXPECT_NEAR(std::accumulate(run.share.begin(), run.share.end(), 0.0), 1.0, 1e-9);
      double samples = 0.0;
      for (std::size_t r = 0; r < run.spp.size(); ++r) {
        samples += data->pixels[r] > 0 ? run.spp[r] * double(data->pixels[r]) : 0.0;
      }
      EXPECT_NEAR(samples / (96.0 * 54.0), run.mean_spp, 1e-9);
      // Black: one sample a frame, and some more beside the outlines, which vote for neighbours.
      EXPECT_GE(run.spp[index_of(RegionId::margin)], 6.0);
      EXPECT_LT(run.spp[index_of(RegionId::margin)], 7.5);
      EXPECT_GT(run.lit_spp, run.mean_spp);
      EXPECT_GT(run.uniform_relmse, 0.0);
      EXPECT_GT(run.uniform_flip, 0.0);
    }
  }
  // What a sample is decides everything: the same twice.
  const auto again = measure_claims(world, found, 6, 1, {}, [](double, std::string_view) {});
  for (std::size_t c = 0; c < report_criterion_count; ++c) {
    EXPECT_EQ(again->seeds[0].runs[c].relmse, data->seeds[0].runs[c].relmse);
    EXPECT_EQ(again->seeds[0].runs[c].firefly.fireflies, data->seeds[0].runs[c].firefly.fireflies);
    EXPECT_EQ(again->seeds[0].runs[c].firefly.nearby, data->seeds[0].runs[c].firefly.nearby);
  }
}

}  // namespace
}  // namespace quartet
