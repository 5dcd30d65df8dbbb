#include "renderer/study/claims.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "renderer/measure/energy.h"
#include "renderer/measure/reference/reference_render.h"
#include "renderer/measure/top_share.h"
#include "renderer/scene/load_scene.h"
#include "tests/study/claim_data.h"
#include "tests/trace/statistics.h"

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
    seed.highest_with_contrast = 0.5;
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
      run.spp[index_of(RegionId::dark_borders)] = (is_contrast ? 59.0 : 50.0) * wobble;
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

std::vector<ClaimVerdict> verdicts(const ClaimData& data) {
  std::vector<ClaimVerdict> all;
  for (const Claim& claim : judge_claims(data)) {
    all.push_back(claim.verdict);
  }
  return all;
}

template <class Change>
ClaimVerdict verdict_after(std::size_t claim, const Change& change) {
  ClaimData data = obedient_data();
  for (ClaimSeed& seed : data.seeds) {
    change(seed);
  }
  const auto all = verdicts(data);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i != claim) {
      EXPECT_EQ(all[i], ClaimVerdict::holds) << "finding " << i + 1;
    }
  }
  return all[claim];
}

TEST(Claims, HoldWhereTheyShould) {
  const std::vector<Claim> claims = judge_claims(obedient_data());
  ASSERT_EQ(claims.size(), 6u);
  for (std::size_t i = 0; i < claims.size(); ++i) {
    EXPECT_EQ(claims[i].number, i < 5 ? int(i) + 1 : 1);
    EXPECT_EQ(claims[i].added, i == 5) << "the ball's shadow";
    for (const ClaimCheck& check : claims[i].checks) {
      EXPECT_EQ(check.verdict, ClaimVerdict::holds) << check.text;
    }
    EXPECT_EQ(claims[i].verdict, ClaimVerdict::holds) << claims[i].text;
  }
}

TEST(Claims, EachFailsWithItsCondition) {
  const auto set = [](std::size_t criterion, RegionId id, double spp) {
    return [=](ClaimSeed& s) { s.runs[criterion].spp[index_of(id)] = spp; };
  };
  EXPECT_EQ(verdict_after(5, set(0, RegionId::ball_shadow, 29.0)), ClaimVerdict::does_not_hold);
  EXPECT_EQ(verdict_after(0, set(2, RegionId::ceiling, 60.0)), ClaimVerdict::does_not_hold)
      << "more than contrast";
  EXPECT_EQ(verdict_after(1, set(1, RegionId::bright_squares, 24.0)), ClaimVerdict::does_not_hold)
      << "less than contrast";
  EXPECT_EQ(verdict_after(1, set(0, RegionId::dark_borders, 45.0)), ClaimVerdict::does_not_hold)
      << "less even than the divergences";
  EXPECT_EQ(verdict_after(2, [](ClaimSeed& s) { s.highest_with_contrast = 0.98; }),
            ClaimVerdict::does_not_hold);
  EXPECT_EQ(verdict_after(2, [](ClaimSeed& s) { s.runs[3].mean_spp = 26.0; }),
            ClaimVerdict::does_not_hold);
  EXPECT_EQ(verdict_after(3, set(3, RegionId::red_wall, 33.0)), ClaimVerdict::does_not_hold);
  EXPECT_EQ(verdict_after(4, [](ClaimSeed& s) { s.runs[1].firefly.nearby = 1.0; }),
            ClaimVerdict::does_not_hold);
}

TEST(Claims, AreUndecidedWhereSeedsDisagreeOrThereIsOne) {
  int k = 0;
  EXPECT_EQ(verdict_after(2, [&](ClaimSeed& s) { s.lowest_correlation = k++ % 2 ? 0.99 : 0.2; }),
            ClaimVerdict::undecided);
  ClaimData data = obedient_data();
  data.seeds.resize(1);
  for (const ClaimVerdict verdict : verdicts(data)) {
    EXPECT_EQ(verdict, ClaimVerdict::undecided);
  }
}

TEST(Claims, TheRaceIsAGeometricMean) {
  const Interval relmse = against_uniform(obedient_data(), 0, MetricId::relmse);
  EXPECT_NEAR(relmse.mean, 0.5 * std::pow(1.0 * 1.001 * 1.002 * 1.003, 0.25), 1e-12);
  EXPECT_LT(relmse.low, relmse.mean);
  EXPECT_LT(relmse.high, 1.0);
  EXPECT_GT(against_uniform(obedient_data(), 2, MetricId::flip).low, 1.0);
}

// Of two values the standard error of the mean is half their distance; t of one degree of freedom
// at 95 % is tan(0.95 π / 2).
const double cauchy_quantile = std::tan(0.475 * M_PI);

TEST(Claims, ComparesWhatEachConditionSays) {
  struct Expected {
    const char* text;
    double low, high;  // of the two seeds
  };
  // A region's number r gives (r² + 10) (c + 1) samples a pixel, of 10 − c; ceiling 0, bright
  // squares 1, dark squares 2, bright borders 3, dark borders 4, shadow 7, front 9, green 10, red
  // 11, margin 12.
  const std::vector<std::vector<Expected>> findings{
      {{"contrast: ceiling / mean lit pixel > 1", 10.0 / 8, 10.0 / 8},
       {"contrast / kl: ceiling / mean pixel > 1", 9.0 / 20, 9.0 / 20},
       {"contrast / chi2: ceiling / mean pixel > 1", 8.0 / 30, 8.0 / 30},
       {"contrast / hellinger: ceiling / mean pixel > 1", 7.0 / 40, 7.0 / 40}},
      {{"kl / contrast: bright / dark squares > 1", 1, 1},
       {"contrast - kl: |log| of bright / dark side of borders < 0", 0, 0},
       {"chi2 / contrast: bright / dark squares > 1", 1, 1},
       {"contrast - chi2: |log| of bright / dark side of borders < 0", 0, 0},
       {"hellinger / contrast: bright / dark squares > 1", 1, 1},
       {"contrast - hellinger: |log| of bright / dark side of borders < 0", 0, 0},
       {"contrast: bright-borders / bright-squares > 1", 19.0 / 11, 19.0 / 11},
       {"contrast: dark-borders / dark-squares > 1", 26.0 / 14, 26.0 / 14}},
      {{"correlation of samples a pixel: lowest of two divergences - highest with contrast > 0",
        -0.25, 0.625},
       {"hellinger / kl: mean spp < 1", 7.0 / 9, 7.0 / 9},
       {"hellinger / chi2: mean spp < 1", 7.0 / 8, 7.0 / 8}},
      {{"contrast: box-front / mean lit pixel < 1", 91.0 / 8, 91.0 / 8},
       {"kl: box-front / mean lit pixel < 1", 91.0 / 8, 91.0 / 8},
       {"chi2: box-front / mean lit pixel < 1", 91.0 / 8, 91.0 / 8},
       {"hellinger: box-front / mean lit pixel < 1", 91.0 / 8, 91.0 / 8},
       {"contrast: green-wall / mean lit pixel < 1", 110.0 / 8, 110.0 / 8},
       {"kl: green-wall / mean lit pixel < 1", 110.0 / 8, 110.0 / 8},
       {"chi2: green-wall / mean lit pixel < 1", 110.0 / 8, 110.0 / 8},
       {"hellinger: green-wall / mean lit pixel < 1", 110.0 / 8, 110.0 / 8},
       {"contrast: red-wall / mean lit pixel < 1", 131.0 / 8, 131.0 / 8},
       {"kl: red-wall / mean lit pixel < 1", 131.0 / 8, 131.0 / 8},
       {"chi2: red-wall / mean lit pixel < 1", 131.0 / 8, 131.0 / 8},
       {"hellinger: red-wall / mean lit pixel < 1", 131.0 / 8, 131.0 / 8},
       {"contrast: margin / mean lit pixel < 1", 154.0 / 8, 154.0 / 8},
       {"kl: margin / mean lit pixel < 1", 154.0 / 8, 154.0 / 8},
       {"chi2: margin / mean lit pixel < 1", 154.0 / 8, 154.0 / 8},
       {"hellinger: margin / mean lit pixel < 1", 154.0 / 8, 154.0 / 8}},
      {{"contrast: samples next pass, a neighbour minus a pixel 4 away > 0", 3, 9},
       {"kl: samples next pass, a neighbour minus a pixel 4 away > 0", 6, 18},
       {"chi2: samples next pass, a neighbour minus a pixel 4 away > 0", 9, 27},
       {"hellinger: samples next pass, a neighbour minus a pixel 4 away > 0", 12, 36}},
      {{"contrast: ball-shadow / mean lit pixel > 1", 59.0 / 8, 59.0 / 8},
       {"contrast / kl: ball-shadow / mean pixel > 1", 9.0 / 20, 9.0 / 20},
       {"contrast / chi2: ball-shadow / mean pixel > 1", 8.0 / 30, 8.0 / 30},
       {"contrast / hellinger: ball-shadow / mean pixel > 1", 7.0 / 40, 7.0 / 40}}};
  // 39 conditions, all together at 95 %.
  const double t = std::tan(0.5 * M_PI * std::pow(0.95, 1.0 / 39.0));
  const std::vector<Claim> claims = judge_claims(test::numbered_claim_data());
  ASSERT_EQ(claims.size(), findings.size());
  for (std::size_t i = 0; i < claims.size(); ++i) {
    ASSERT_EQ(claims[i].checks.size(), findings[i].size()) << "finding " << i + 1;
    for (std::size_t k = 0; k < findings[i].size(); ++k) {
      const ClaimCheck& check = claims[i].checks[k];
      const Expected& expected = findings[i][k];
      SCOPED_TRACE(expected.text);
      EXPECT_EQ(check.text, expected.text);
      const double middle = 0.5 * (expected.low + expected.high);
      const double half = t * 0.5 * std::abs(expected.high - expected.low);
      EXPECT_NEAR(check.value.mean, middle, 1e-9);
      EXPECT_NEAR(check.value.low, middle - half, 1e-5 * half + 1e-9);
      EXPECT_NEAR(check.value.high, middle + half, 1e-5 * half + 1e-9);
    }
  }
}

TEST(Claims, AgainstUniformIsEachErrorOverItsOwnOfUniformSampling) {
  // Seeds 1 and 3 times (c + 1): a geometric mean of √3.
  for (std::size_t c = 0; c < report_criterion_count; ++c) {
    const double middle = std::sqrt(3.0) * double(c + 1);
    const double spread = std::pow(std::sqrt(3.0), cauchy_quantile);
    const Interval relmse = against_uniform(test::numbered_claim_data(), c, MetricId::relmse);
    EXPECT_NEAR(relmse.mean, middle / 4.0, 1e-9);
    EXPECT_NEAR(relmse.low * spread / relmse.mean, 1.0, 1e-6);
    EXPECT_NEAR(relmse.high / spread / relmse.mean, 1.0, 1e-6);
    EXPECT_NEAR(against_uniform(test::numbered_claim_data(), c, MetricId::flip).mean,
                2.0 * middle / 32.0, 1e-9);
  }
}

/// Its luminance by our weights is 0.299 R + 0.587 G + 0.114 B of what it was.
SampleSource weighed_as_in_the_report(SampleSource source) {
  return [source = std::move(source)](std::span<SampleJob> jobs) {
    source(jobs);
    for (SampleJob& job : jobs) {
      for (glm::vec3& sample : job.radiance) {
        sample *= glm::vec3(0.299f / 0.2126f, 0.587f / 0.7152f, 0.114f / 0.0722f);
      }
    }
  };
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
      // Black: one sample a pass, and some more beside the outlines, which vote for neighbours.
      EXPECT_GE(run.spp[index_of(RegionId::margin)], 6.0);
      EXPECT_LT(run.spp[index_of(RegionId::margin)], 7.5);
      EXPECT_GT(run.lit_spp, run.mean_spp);
      EXPECT_GT(run.uniform_relmse, 0.0);
      EXPECT_GT(run.uniform_flip, 0.0);
    }
  }
  // Each criterion is what a lab alone gives.
  std::vector<std::vector<std::uint32_t>> maps;
  for (std::size_t c = 0; c < report_criterion_count; ++c) {
    SCOPED_TRACE(estimator(report_criteria[c]).id);
    const LaneSettings lane_settings = default_settings(report_criteria[c]);
    Lab alone(weighed_as_in_the_report(world.source(world.first_seed)), 96, 54,
              std::span(&lane_settings, 1));
    while (alone.pass() < 6) {
      alone.run_pass();
    }
    const Lane& lane = alone.lanes()[0];
    const ClaimRun& run = data->seeds[0].runs[c];
    RadianceImage picture = lane.film().image();
    for (glm::vec3& pixel : picture.pixels()) {
      pixel *= glm::vec3(0.2126f / 0.299f, 0.7152f / 0.587f, 0.0722f / 0.114f);
    }
    EXPECT_NEAR(run.relmse, metric(MetricId::relmse).compute(picture, reference->image), 1e-5);
    EXPECT_NEAR(run.relmse_top, relmse_top_share(picture, reference->image), 1e-4);
    EXPECT_NEAR(run.flip, metric(MetricId::flip).compute(picture, reference->image), 1e-4);
    EXPECT_NEAR(run.energy, energy_error(picture, reference->image), 1e-5);
    std::vector<double> samples(regions().size(), 0.0);
    double lit = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      samples[index_of(found[i])] += lane.taken()[i];
      lit += found[i] == RegionId::margin ? 0.0 : lane.taken()[i];
    }
    for (std::size_t r = 0; r < samples.size(); ++r) {
      if (data->pixels[r] > 0) {
        EXPECT_NEAR(run.spp[r], samples[r] / double(data->pixels[r]), 1e-9);
      }
      EXPECT_NEAR(run.share[r], samples[r] / double(lane.history().back().samples), 1e-12);
    }
    EXPECT_NEAR(run.lit_spp, lit / double(found.size() - data->pixels[index_of(RegionId::margin)]),
                1e-9);
    maps.emplace_back(lane.taken().begin(), lane.taken().end());
  }
  double lowest = 1.0;
  for (const auto& [a, b] : {std::pair{1, 2}, {1, 3}, {2, 3}}) {
    test::Correlation correlation;
    for (std::size_t i = 0; i < found.size(); ++i) {
      correlation.add(maps[std::size_t(a)][i], maps[std::size_t(b)][i]);
    }
    lowest = std::min(lowest, correlation.coefficient());
  }
  EXPECT_NEAR(data->seeds[0].lowest_correlation, lowest, 1e-9);
  // What a sample is decides everything: a seed gives the same, whichever it is of several.
  SampleWorld second = world;
  ++second.first_seed;
  const auto again = measure_claims(second, found, 6, 1, {}, [](double, std::string_view) {});
  for (std::size_t c = 0; c < report_criterion_count; ++c) {
    const ClaimRun& run = data->seeds[1].runs[c];
    EXPECT_EQ(again->seeds[0].runs[c].relmse, run.relmse);
    EXPECT_EQ(again->seeds[0].runs[c].flip, run.flip);
    EXPECT_EQ(again->seeds[0].runs[c].share, run.share);
    EXPECT_EQ(again->seeds[0].runs[c].firefly.fireflies, run.firefly.fireflies);
    EXPECT_EQ(again->seeds[0].runs[c].firefly.nearby, run.firefly.nearby);
    EXPECT_NE(data->seeds[0].runs[c].relmse, run.relmse) << "other random numbers";
  }
}

}  // namespace
}  // namespace quartet
