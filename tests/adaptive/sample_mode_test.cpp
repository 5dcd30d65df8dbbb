#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "renderer/adaptive/lab.h"

// What the samples that decide do to the mean, exactly: each pixel of a picture is one possible
// outcome of a pixel whose samples are 1 with probability 0.1 and else 0, and its bits are those
// samples. The lab runs all outcomes at once, with its own films, errors and plans; the expectation
// is the mean over pixels, weighted with their probabilities. Nothing is random here.

namespace quartet {
namespace {

constexpr double p = 0.1;

double probability(std::uint32_t outcome, int bits) {
  double product = 1.0;
  for (int i = 0; i < bits; ++i) {
    product *= (outcome >> i & 1u) != 0 ? p : 1.0 - p;
  }
  return product;
}

/// Sample i of a pixel is bit `shift` + i of its number.
SampleSource bits_of_pixel(int width, int shift) {
  return [=](int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) {
    const std::uint32_t outcome = std::uint32_t(y * width + x) >> shift;
    for (std::uint32_t i = 0; i < radiance.size(); ++i) {
      radiance[i] = glm::vec3(first + i < 32 && (outcome >> (first + i) & 1u) != 0 ? 1.0f : 0.0f);
    }
  };
}

/// A pilot of `first` samples, and up to `most` in all where they differ.
LaneSettings pilot_settings(std::uint16_t first, std::uint16_t most, SampleMode mode) {
  LaneSettings settings = default_settings(EstimatorId::rigau_chi2);
  settings.policy.kind = PolicyId::batch;
  settings.policy.first = first;
  settings.policy.batch = std::uint16_t(most - first);
  settings.max_spp = most;
  settings.thresholds[0] = 1e-6f;
  settings.mode = mode;
  return settings;
}

void run_to_end(Lab& lab) {
  for (int pass = 0; pass < 4; ++pass) {
    ASSERT_TRUE(lab.run_pass());
  }
  ASSERT_EQ(lab.lanes()[0].plan().total, 0u);
}

double expected_mean(const Lane& lane, int bits) {
  double sum = 0.0;
  for (std::size_t i = 0; i < lane.film().size(); ++i) {
    sum += probability(std::uint32_t(i), bits) * double(lane.film().mean(0)[i]);
  }
  return sum;
}

TEST(SampleMode, PilotsKeptInTheMeanAreBiased) {
  // 4 pilots, 12 more if they differ: 2^16 outcomes.
  const LaneSettings settings = pilot_settings(4, 16, SampleMode::reuse);
  Lab lab(bits_of_pixel(256, 0), 256, 256, std::span(&settings, 1));
  run_to_end(lab);
  // Kept where all are 0 or all are 1, else the pilots and 12 · p over 16.
  const double same = std::pow(1.0 - p, 4) + std::pow(p, 4);
  const double exact =
      std::pow(p, 4) + (4.0 * p - 4.0 * std::pow(p, 4) + 12.0 * p * (1.0 - same)) / 16.0;
  EXPECT_NEAR(exact, 0.05086, 5e-6);
  EXPECT_NEAR(expected_mean(lab.lanes()[0], 16), exact, 1e-8);
}

TEST(SampleMode, PilotsNeverShownAreNot) {
  // 4 pilots, 4 more if they differ: 4 bits for the pilot run, 8 for what is shown.
  const LaneSettings settings = pilot_settings(4, 8, SampleMode::unbiased);
  LabOptions options;
  options.pilot_source = bits_of_pixel(64, 0);
  Lab lab(bits_of_pixel(64, 4), 64, 64, std::span(&settings, 1), options);
  run_to_end(lab);
  EXPECT_NEAR(expected_mean(lab.lanes()[0], 12), p, 1e-8);
  // The same with the pilots kept, so that the test could fail.
  const LaneSettings biased = pilot_settings(4, 8, SampleMode::reuse);
  Lab kept(bits_of_pixel(64, 4), 64, 64, std::span(&biased, 1));
  run_to_end(kept);
  EXPECT_LT(expected_mean(kept.lanes()[0], 12), 0.9 * p);
}

TEST(SampleMode, TheBiasVanishesAtOneHalf) {
  // By symmetry: which is why no test uses it.
  const LaneSettings settings = pilot_settings(4, 8, SampleMode::reuse);
  Lab lab(bits_of_pixel(16, 0), 16, 16, std::span(&settings, 1));
  run_to_end(lab);
  double sum = 0.0;
  for (const float mean : lab.lanes()[0].film().mean(0)) {
    sum += double(mean) / 256.0;
  }
  EXPECT_NEAR(sum, 0.5, 1e-8);
}

TEST(SampleMode, ThePilotIsChargedAndNotShown) {
  const LaneSettings lane_settings[] = {pilot_settings(4, 8, SampleMode::unbiased),
                                        pilot_settings(4, 8, SampleMode::reuse)};
  LabOptions options;
  options.pilot_source = bits_of_pixel(64, 0);
  Lab lab(bits_of_pixel(64, 4), 64, 64, lane_settings, options);
  run_to_end(lab);
  const Lane& lane = lab.lanes()[0];
  std::uint64_t shown = 0;
  for (std::size_t i = 0; i < lane.film().size(); ++i) {
    const std::uint32_t pilot = std::uint32_t(i) & 15u;
    EXPECT_EQ(lane.taken()[i], pilot == 0 || pilot == 15 ? 4u : 8u);
    EXPECT_EQ(lane.film().counts()[i], lane.taken()[i]);
    EXPECT_EQ(lane.deciding_film().counts()[i], lane.taken()[i]);
    shown += lane.taken()[i];
  }
  const PassRecord& last = lane.history().back();
  EXPECT_EQ(last.samples, 2 * shown);
  EXPECT_EQ(last.pilot_samples, shown);
  EXPECT_EQ(last.max_spp, 8u);
  const PassRecord& reused = lab.lanes()[1].history().back();
  EXPECT_EQ(reused.pilot_samples, 0u);
  ASSERT_NE(lab.pilot_store(), nullptr);
  EXPECT_EQ(lab.pilot_store()->traced(), shown);
  // The seconds of both stores, as far as the lane took them; its own come on top.
  EXPECT_GT(last.tracing_seconds, reused.tracing_seconds);
  EXPECT_GT(last.seconds, last.tracing_seconds);
}

TEST(SampleMode, WhatAModeNeedsMustBeThere) {
  const LaneSettings settings = pilot_settings(4, 8, SampleMode::unbiased);
  try {
    Lab lab(bits_of_pixel(64, 4), 64, 64, std::span(&settings, 1));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("unbiased"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace quartet
