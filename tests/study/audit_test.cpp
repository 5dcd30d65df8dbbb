#include "renderer/study/stability/audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "renderer/scene/synthetic.h"

namespace quartet {
namespace {

constexpr int audited_width = 64;
constexpr int audited_height = 48;

SampleSource source_of(std::string_view id, std::uint64_t seed) {
  return [row = &find_synthetic(id), seed](int x, int y, std::uint32_t first,
                                           std::span<glm::vec3> radiance) {
    draw_synthetic(*row, seed, x, y, first, radiance);
  };
}

std::size_t wrong_in(std::span<const Audit::Look> looks) {
  return std::size_t(std::ranges::count(looks, true, &Audit::Look::wrong));
}

// 3 072 lots at 1 in 4: standard deviation 24; false alarms under 1e-6.
TEST(Audit, LooksAtTheShareOfPixelsThatWasAskedFor) {
  const Audit audit(source_of("log-normal", 1), audited_width, audited_height, 0.25, 2, 9);
  EXPECT_NEAR(double(audit.pixels().size()), 768.0, 120.0);
  const Audit other(source_of("log-normal", 1), audited_width, audited_height, 0.25, 2, 10);
  std::size_t common = 0;
  for (const Audit::Pixel& a : audit.pixels()) {
    for (const Audit::Pixel& b : other.pixels()) {
      common += a.pixel == b.pixel ? 1 : 0;
    }
  }
  EXPECT_NEAR(double(common), 192.0, 70.0);  // independent of each other
}

TEST(Audit, MeansAndTheirVarianceAreThoseOfTheSource) {
  const Synthetic& row = find_synthetic("bernoulli");
  constexpr std::uint32_t samples = 400;
  const Audit audit(source_of("bernoulli", 3), audited_width, audited_height, 1.0, samples, 0);
  ASSERT_EQ(audit.pixels().size(), std::size_t(audited_width) * audited_height);
  double mean = 0.0;
  double variance = 0.0;
  for (const Audit::Pixel& pixel : audit.pixels()) {
    mean += pixel.mean.y / double(audit.pixels().size());
    variance += pixel.variance_of_mean.y / double(audit.pixels().size());
  }
  // Over a million samples; five standard deviations.
  EXPECT_NEAR(mean, row.mean, 5.0 * std::sqrt(row.variance / (samples * 3072.0)));
  EXPECT_NEAR(variance * samples / row.variance, 1.0, 0.02);
}

TEST(Audit, RejectsWhatAFilmRejects) {
  const Audit audit(source_of("non-finite", 3), 8, 8, 1.0, 500, 0);
  for (const Audit::Pixel& pixel : audit.pixels()) {
    EXPECT_NEAR(pixel.mean.x, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / 480.0));
    EXPECT_TRUE(std::isfinite(pixel.variance_of_mean.x));
  }
}

// Two samples, 1 and 3: mean 2, and 1 is the variance of that mean. A picture of x is off by
// ((x − 2)² − 1) / (4 + 0.01).
TEST(Audit, TakesItsOwnNoiseOffTheError) {
  const SampleSource hidden = [](int, int, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      radiance[i] = glm::vec3((first + i) % 2 == 0 ? 1.0f : 3.0f);
    }
  };
  const Audit audit(hidden, 4, 1, 1.0, 2, 0);
  ASSERT_EQ(audit.pixels().size(), 4u);
  EXPECT_DOUBLE_EQ(audit.pixels()[0].mean.y, 2.0);
  EXPECT_DOUBLE_EQ(audit.pixels()[0].variance_of_mean.y, 1.0);
  const std::vector<PixelState> states{PixelState::done, PixelState::done, PixelState::refining,
                                       PixelState::done};
  const std::vector<float> mean{5.0f, 3.0f, 5.0f, 2.0f};
  const std::array<std::span<const float>, 3> means{mean, mean, mean};
  const double error = 8.0 / 4.01;
  EXPECT_EQ(audit.check(states, means, error - 1e-9).size(), 3u);
  EXPECT_EQ(wrong_in(audit.check(states, means, error - 1e-9)), 1u);
  EXPECT_EQ(wrong_in(audit.check(states, means, error + 1e-9)), 0u);
  EXPECT_EQ(wrong_in(audit.check(states, means, 1e-9)), 1u) << "3 is off by no more than the noise";
}

// Every second pixel of the picture is wrong by a fifth of the truth, the others are right; every
// third is not done. The audit's noise, 0.0003 in squared relative error, is far from the target.
TEST(Audit, FindsWhatIsDoneAndWrong) {
  const Audit audit(source_of("negative", 3), audited_width, audited_height, 0.5, 4000, 5);
  std::vector<float> mean(std::size_t(audited_width) * audited_height, 0.5f);
  std::vector<PixelState> states(mean.size(), PixelState::done);
  std::size_t done = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    mean[i] *= i % 2 == 0 ? 1.2f : 1.0f;
    states[i] = i % 3 == 0 ? PixelState::at_maximum : PixelState::done;
  }
  for (const Audit::Pixel& pixel : audit.pixels()) {
    done += pixel.pixel % 3 == 0 ? 0 : 1;
    wrong += pixel.pixel % 3 != 0 && pixel.pixel % 2 == 0 ? 1 : 0;
  }
  const std::vector<Audit::Look> looks = audit.check(states, {mean, mean, mean}, 0.02);
  EXPECT_EQ(looks.size(), done);
  EXPECT_EQ(wrong_in(looks), wrong);
  EXPECT_EQ(wrong_in(audit.check(states, {mean, mean, mean}, 0.1)), 0u);
}

// Three pixels, looked at 2, 2 and 4 times, of which 2, 0 and 1 are wrong: 3 of 8. The squares of
// what each is off from 3/8 of its looks add up to 1.25² + 0.75² + 0.5² = 2.375.
TEST(Audit, AShareCountsPixelsAndNotLooks) {
  std::vector<Audit::Look> looks;
  const auto add = [&](std::size_t pixel, int count, int wrong) {
    for (int i = 0; i < count; ++i) {
      looks.push_back({pixel, i < wrong});
    }
  };
  add(7, 2, 2);
  add(9, 2, 0);
  add(3, 4, 1);
  const double variance = 2.375 / 64.0 * 3.0 / 2.0;
  const double independent = 0.375 * 0.625 / variance;
  const Interval expected = share_interval(0.375 * independent, independent, 0.05);
  const Interval interval = wrong_share_interval(looks, 0.05);
  EXPECT_NEAR(interval.mean, 0.375, 1e-12);
  EXPECT_NEAR(interval.low, expected.low, 1e-12);
  EXPECT_NEAR(interval.high, expected.high, 1e-12);
  EXPECT_LT(independent, 8.0);
  // Five runs that all say that one pixel is right are one look, not five.
  looks.clear();
  add(7, 5, 0);
  EXPECT_DOUBLE_EQ(wrong_share_interval(looks, 0.05).high, share_interval(0.0, 1.0, 0.05).high);
  EXPECT_EQ(wrong_share_interval({}, 0.05).low, 0.0);
  EXPECT_EQ(wrong_share_interval({}, 0.05).high, 1.0);
}

// Every pixel has a chance of its own to be wrong, 0.1 or 0.5, and is looked at by 12 runs. Of 1000
// such studies a 95 % interval misses 50; five standard deviations more are 84. If looks counted as
// independent, some 230 would miss.
TEST(Audit, ASharesIntervalHoldsTheTruthAsOftenAsItSays) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  int missed = 0;
  for (int study = 0; study < 1000; ++study) {
    std::vector<Audit::Look> looks;
    for (std::size_t pixel = 0; pixel < 100; ++pixel) {
      const double chance = uniform(random) < 0.5 ? 0.1 : 0.5;
      for (int run = 0; run < 12; ++run) {
        looks.push_back({pixel, uniform(random) < chance});
      }
    }
    missed += wrong_share_interval(looks, 0.05).contains(0.3) ? 0 : 1;
  }
  EXPECT_LE(missed, 84);
  EXPECT_GE(missed, 16);
}

}  // namespace
}  // namespace quartet
