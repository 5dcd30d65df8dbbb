#include "renderer/study/stability/outcome.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/adaptive/lab.h"
#include "renderer/study/stability/uniform_run.h"

// A lane made by hand: the oracle sees which pixels are to be done, the truth says which are
// wrong, and every sample of a pixel is the same but for two that no film takes.

namespace quartet {
namespace {

constexpr int made_width = 6;
constexpr int made_height = 2;
constexpr std::size_t made_pixels = std::size_t(made_width) * made_height;
constexpr PixelRegion made_region{1, 0, 6, 2};  // all but the first column
constexpr double made_limit = 0.025;            // wrong: a squared error above 0.1

/// A pixel shows 1; it is done if the oracle's reference says so too, else it is off by 1. The
/// truth of a wrong one is 2.
struct Made {
  bool done;
  bool wrong;
};

// Outside of the region: two that are done, one of them wrong and four times as bright.
// Within: done and right 3, done and wrong 1, at the maximum and right 2, at the maximum and wrong
// 4.
constexpr std::array<Made, made_pixels> made{{
    {true, false},
    {true, false},
    {true, true},
    {false, false},
    {false, true},
    {false, true},
    {true, true},
    {true, false},
    {false, true},
    {false, false},
    {true, false},
    {false, true},
}};
constexpr std::size_t bright = 6;

float scale_of(std::size_t pixel) {
  return pixel == bright ? 4.0f : 1.0f;
}

RadianceImage true_picture() {
  RadianceImage image(made_width, made_height);
  for (std::size_t i = 0; i < made_pixels; ++i) {
    image.pixels()[i] = glm::vec3(scale_of(i) * (made[i].wrong ? 2.0f : 1.0f));
  }
  return image;
}

/// What the oracle compares with.
RadianceImage oracle_picture() {
  RadianceImage image(made_width, made_height);
  for (std::size_t i = 0; i < made_pixels; ++i) {
    image.pixels()[i] = glm::vec3(scale_of(i) + (made[i].done ? 0.0f : 1.0f));
  }
  return image;
}

void sample_made(int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) {
  const auto pixel = std::size_t(y * made_width + x);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    const std::size_t index = first + i;
    const bool bad = (pixel == 1 && index == 1) || (pixel == 4 && index == 6);
    radiance[i] = glm::vec3(bad ? std::numeric_limits<float>::quiet_NaN() : scale_of(pixel));
  }
}

/// Four samples of each pixel, then two more of those that are not done, up to eight.
LaneSettings made_settings(SampleMode mode = SampleMode::reuse) {
  LaneSettings settings = default_settings(EstimatorId::oracle);
  settings.policy.kind = PolicyId::batch;
  settings.policy.first = 4;
  settings.policy.batch = 2;
  settings.thresholds[0] = 0.25f;
  settings.max_spp = 8;
  settings.mode = mode;
  return settings;
}

Lab made_lab(const LaneSettings& settings) {
  LabOptions options;
  options.reference = std::make_shared<const RadianceImage>(oracle_picture());
  options.pilot_source = SampleSource(sample_made);
  return {SampleSource(sample_made), made_width, made_height, std::span(&settings, 1), options};
}

Truth made_truth() {
  Truth truth;
  truth.image = std::make_shared<const RadianceImage>(true_picture());
  return truth;
}

/// With the eight samples that it ends with, a pixel that is not done and right is expected to have
/// less than the limit, from four on even; a wrong one is expected to be wrong. Of the two that are
/// done and right in the upper row, the first is expected to be wrong.
Judgement made_judgement() {
  auto expected = std::make_shared<RadianceImage>(made_width, made_height);
  for (std::size_t i = 0; i < made_pixels; ++i) {
    const bool bad = made[i].wrong || i == 1;
    expected->pixels()[i] = glm::vec3(bad ? 8.0f : 0.0625f);
  }
  return {made_truth(), expected, made_limit, made_region};
}

/// Knows the truth of every pixel without noise.
Audit made_audit() {
  const SampleSource hidden = [](int x, int y, std::uint32_t, std::span<glm::vec3> radiance) {
    std::ranges::fill(radiance, true_picture().at(x, y));
  };
  return {hidden, made_width, made_height, 1.0, 2, 0};
}

/// The lane and its outcome, once it wants no more.
Outcome run_to_end(Lab& lab) {
  const Judgement judgement = made_judgement();
  Observation observation(judgement);
  while (lab.lanes()[0].plan().total > 0) {
    observation.before_pass(lab.lanes()[0]);
    lab.run_pass();
  }
  const std::vector<std::uint32_t> even(made_pixels, 6);
  return observation.outcome(lab.lanes()[0], even, made_audit());
}

TEST(Outcome, OfALaneByHand) {
  Lab lab = made_lab(made_settings());
  const Outcome outcome = run_to_end(lab);
  const Lane& lane = lab.lanes()[0];
  ASSERT_EQ(lane.pass(), 3u);
  const std::vector<std::uint32_t> taken(lane.taken().begin(), lane.taken().end());
  ASSERT_EQ(taken, (std::vector<std::uint32_t>{4, 4, 4, 8, 8, 8, 4, 4, 8, 8, 4, 8}));

  // 72 samples of 12 pixels, 64 of them of the region's 10.
  EXPECT_DOUBLE_EQ(outcome.mean_spp, 6.0);
  EXPECT_DOUBLE_EQ(outcome.region_spp, 6.4);
  EXPECT_EQ(outcome.seconds, lane.history().back().seconds);
  EXPECT_NEAR(outcome.rejected, 2.0 / 72.0, 1e-12);
  // Off by 1 from 2, five times, and by 4 from 8.
  const double usual = 1.0 / 4.01;
  const double most = 16.0 / 64.01;
  EXPECT_NEAR(outcome.relmse, (5.0 * usual + most) / 12.0, 1e-6);
  EXPECT_NEAR(outcome.worst, most, 1e-6);
  EXPECT_EQ(outcome.fireflies, 0.0);
  EXPECT_NEAR(outcome.energy, 15.0 / 24.0 - 1.0, 1e-6);
  EXPECT_NEAR(outcome.region_energy, 10.0 / 15.0 - 1.0, 1e-6);
  // Of the region.
  EXPECT_DOUBLE_EQ(outcome.done, 0.4);
  EXPECT_DOUBLE_EQ(outcome.missed, 0.25);
  EXPECT_DOUBLE_EQ(outcome.too_early, 0.5);
  EXPECT_DOUBLE_EQ(outcome.never_done, 0.2);
  EXPECT_DOUBLE_EQ(outcome.never_done_cost, 16.0 / 72.0);
  EXPECT_EQ(outcome.audit.size(), 4u);
  EXPECT_EQ(std::ranges::count(outcome.audit, true, &Audit::Look::wrong), 1);
  // Two passes after the first gave two samples each to six pixels, two of which are not
  // wrong.
  EXPECT_DOUBLE_EQ(outcome.wasted, 1.0 / 3.0);
  // Six pixels have 2 of 72 samples too few, six as many too many.
  EXPECT_DOUBLE_EQ(outcome.off_oracle, 1.0 / 6.0);
}

TEST(Outcome, OfALaneWithAPilotCountsItsSamplesToo) {
  Lab lab = made_lab(made_settings(SampleMode::unbiased));
  const Outcome outcome = run_to_end(lab);
  EXPECT_DOUBLE_EQ(outcome.mean_spp, 12.0);
  EXPECT_DOUBLE_EQ(outcome.region_spp, 6.4);
  EXPECT_DOUBLE_EQ(outcome.never_done_cost, 16.0 / 144.0);
  EXPECT_DOUBLE_EQ(outcome.wasted, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(outcome.done, 0.4);
}

TEST(Outcome, PixelStatesFollowErrorsSamplesAndTheMaximum) {
  Lab lab = made_lab(made_settings());
  for (int pass = 1; pass <= 3; ++pass) {
    lab.run_pass();
    const std::vector<PixelState> states = pixel_states(lab.lanes()[0]);
    for (std::size_t i = 0; i < made_pixels; ++i) {
      EXPECT_EQ(states[i], made[i].done ? PixelState::done
                           : pass < 3   ? PixelState::refining
                                        : PixelState::at_maximum)
          << "pixel " << i << ", pass " << pass;
    }
  }
  // Without an error nothing is ever done.
  LaneSettings uniform = default_settings(EstimatorId::uniform);
  uniform.max_spp = 2;
  Lab plain = made_lab(uniform);
  plain.run_pass();
  EXPECT_EQ(pixel_states(plain.lanes()[0])[0], PixelState::refining);
  plain.run_pass();
  EXPECT_EQ(pixel_states(plain.lanes()[0])[0], PixelState::at_maximum);
}

// Uniform sampling measured at 2 and at 6 samples; a lane between them, and one past the end.
TEST(Outcome, StandsBesideUniformSamplingOfTheSameEffort) {
  const UniformRun uniform(
      std::vector<UniformRun::Point>{{2.0, 20.0, 0.5, -0.25}, {6.0, 40.0, 0.25, 0.125}});
  Truth truth;
  Outcome outcome;
  outcome.mean_spp = 5.0;
  outcome.mean_rays = 25.0;
  outcome.regions = 0.625;
  outcome.region_energy = -0.5;
  set_beside(outcome, uniform, truth);
  // Three quarters of the way in samples, one quarter in rays.
  EXPECT_DOUBLE_EQ(outcome.over_uniform, 0.625 / 0.3125);
  EXPECT_DOUBLE_EQ(outcome.over_uniform_rays, 0.625 / 0.4375);
  EXPECT_DOUBLE_EQ(outcome.off, -0.5) << "of an exact truth";
  truth.spp = 512;
  set_beside(outcome, uniform, truth);
  EXPECT_DOUBLE_EQ(outcome.off, -0.5 - 0.125) << "less that of all uniform samples";
  outcome.mean_spp = 6.5;
  set_beside(outcome, uniform, truth);
  EXPECT_TRUE(std::isnan(outcome.over_uniform)) << "nothing is extrapolated";
  outcome.mean_spp = 1.0;
  set_beside(outcome, uniform, truth);
  EXPECT_TRUE(std::isnan(outcome.over_uniform));
}

TEST(Outcome, UniformSamplingIsMeasuredAtEachSample) {
  const Truth truth = made_truth();
  Lab lab = made_lab(made_settings());
  const auto run = run_uniform(lab, 3, truth, made_region, {});
  ASSERT_TRUE(run);
  for (const double spp : {1.0, 2.0, 3.0}) {
    EXPECT_DOUBLE_EQ(run->at(&UniformRun::Point::mean_spp, spp).mean_spp, spp);
  }
  EXPECT_NEAR(run->last().region_energy, 10.0 / 15.0 - 1.0, 1e-6);
  EXPECT_TRUE(std::isnan(run->at(&UniformRun::Point::mean_spp, 3.5).regions));
}

TEST(Outcome, OfAPictureAlone) {
  // 2000 pixels: the worst thousandth is two of them.
  const RadianceImage truth(50, 40, glm::vec3(0.3f));
  RadianceImage picture = truth;
  const auto brighten = [&](int x, int y, float by) { picture.at(x, y) += glm::vec3(by); };
  brighten(7, 3, 3.0f);    // 5 · (0.3 + 0.1) = 2: a firefly
  brighten(8, 3, 2.5f);    // another one
  brighten(20, 30, 1.5f);  // bright, and none
  brighten(49, 39, -0.3f);
  const Outcome outcome = outcome_of(picture, truth, {0, 0, 10, 10});
  EXPECT_NEAR(outcome.relmse, (9.0 + 6.25 + 2.25 + 0.09) / 0.1 / 2000.0, 1e-5);
  EXPECT_NEAR(outcome.worst, 0.5 * (9.0 + 6.25) / 0.1, 1e-3);
  EXPECT_DOUBLE_EQ(outcome.fireflies, 2.0 / 2000.0);
  EXPECT_NEAR(outcome.energy, (3.0 + 2.5 + 1.5 - 0.3) / 600.0, 1e-6);
  EXPECT_NEAR(outcome.region_energy, (3.0 + 2.5) / 30.0, 1e-5);
  for (const double unknown : {outcome.mean_spp, outcome.seconds, outcome.done, outcome.wasted}) {
    EXPECT_TRUE(std::isnan(unknown));
  }
  // Against black there is no ratio.
  const Outcome black =
      outcome_of(RadianceImage(4, 2, glm::vec3(0.5f)), RadianceImage(4, 2), {0, 0, 4, 2});
  EXPECT_NEAR(black.energy, 0.5, 1e-6);
}

}  // namespace
}  // namespace quartet
