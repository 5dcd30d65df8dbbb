#include "renderer/adaptive/film/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace quartet {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(Film, MeanAndVarianceOfTheMean) {
  std::mt19937 random(1);
  std::exponential_distribution<float> radiance(1.0f);
  std::vector<glm::vec3> samples(1000);
  for (glm::vec3& sample : samples) {
    sample = {radiance(random), 2.0f * radiance(random), 100.0f + radiance(random)};
  }
  Film film(2, 1, {.variance = true});
  // In pieces, as passes do.
  film.add(1, std::span(samples).first(1));
  film.add(1, std::span(samples).subspan(1, 9));
  film.add(1, std::span(samples).subspan(10));
  for (int c = 0; c < 3; ++c) {
    double mean = 0.0;
    for (const glm::vec3& sample : samples) {
      mean += double(sample[c]) / 1000.0;
    }
    double squares = 0.0;
    for (const glm::vec3& sample : samples) {
      squares += (double(sample[c]) - mean) * (double(sample[c]) - mean);
    }
    EXPECT_FLOAT_EQ(film.mean(c)[1], float(mean));
    EXPECT_NEAR(film.variance_of_mean(1)[c], squares / 999.0 / 1000.0, 1e-12);
    EXPECT_EQ(film.mean(c)[0], 0.0f);
  }
  EXPECT_EQ(film.counts()[1], 1000u);
  EXPECT_EQ(film.variance_of_mean(0), glm::dvec3(0.0));
}

TEST(Film, EqualSamplesHaveNoVariance) {
  Film film(1, 1, {.variance = true});
  const std::vector<glm::vec3> samples(1000, glm::vec3(0.1f, 0.7f, 1e6f));
  film.add(0, samples);
  EXPECT_LT(film.variance_of_mean(0).z, 1e-12);
  EXPECT_EQ(film.mean(0)[0], 0.1f);
}

TEST(Film, BadSamplesAreCountedAndLeftOut) {
  const std::vector<glm::vec3> samples{
      {1.0f, 2.0f, 3.0f},    {nan, 0.0f, 0.0f},  {0.0f, infinity, 0.0f}, {0.0f, 0.0f, -infinity},
      {0.0f, -1e-30f, 0.0f}, {3.0f, 2.0f, 1.0f}, {0.0f, 0.0f, -nan}};
  Film film(1, 1, {.variance = true});
  film.add(0, samples);
  EXPECT_EQ(film.counts()[0], 2u);
  EXPECT_EQ(film.rejected()[0], 5u);
  EXPECT_EQ(film.total_rejected(), 5u);
  EXPECT_EQ(film.image().at(0, 0), glm::vec3(2.0f, 2.0f, 2.0f));
  EXPECT_NEAR(film.variance_of_mean(0).x, 1.0, 1e-12);
}

TEST(Film, OnlyBadSamplesLeaveThePixelBlack) {
  Film film(1, 1);
  const glm::vec3 sample(nan);
  film.add(0, {&sample, 1});
  EXPECT_EQ(film.image().at(0, 0), glm::vec3(0.0f));
  EXPECT_EQ(film.counts()[0], 0u);
}

TEST(Film, RightAtTenMillionSamplesAPixel) {
  // A sum in single precision stops growing at 2²⁴.
  Film film(1, 1);
  std::vector<glm::vec3> samples(1000);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = glm::vec3(0.1f + 1e-3f * float(i), 1.0f, 1e-7f);
  }
  double mean = 0.0;
  for (const glm::vec3& sample : samples) {
    mean += double(sample.x) / 1000.0;
  }
  for (int i = 0; i < 10'000; ++i) {
    film.add(0, samples);
  }
  EXPECT_EQ(film.counts()[0], 10'000'000u);
  EXPECT_FLOAT_EQ(film.mean(0)[0], float(mean));
  EXPECT_FLOAT_EQ(film.mean(1)[0], 1.0f);
  EXPECT_FLOAT_EQ(film.mean(2)[0], 1e-7f);
}

TEST(Film, PartsInAnyOrderGiveTheSameMean) {
  // Heavy-tailed: from about 1e-6 to 1e6, so that sums in single precision would differ.
  std::mt19937 random(3);
  std::lognormal_distribution<float> radiance(0.0f, 3.0f);
  constexpr std::size_t part = 1000;
  std::vector<std::vector<glm::vec3>> parts(100, std::vector<glm::vec3>(part));
  for (std::vector<glm::vec3>& samples : parts) {
    for (glm::vec3& sample : samples) {
      sample = {radiance(random), radiance(random), radiance(random)};
    }
  }
  const auto merged = [&] {
    Film film(1, 1, {.chi2 = true});
    for (const std::vector<glm::vec3>& samples : parts) {
      film.add(0, samples);
    }
    return film;
  };
  const Film in_order = merged();
  for (int shuffle = 0; shuffle < 8; ++shuffle) {
    std::ranges::shuffle(parts, random);
    const Film film = merged();
    EXPECT_NEAR(film.mean_luminance(0) / in_order.mean_luminance(0), 1.0, 1e-12);
    for (int c = 0; c < 3; ++c) {
      EXPECT_FLOAT_EQ(film.mean(c)[0], in_order.mean(c)[0]);
    }
  }
}

TEST(Film, StatisticsRightAtTenMillionSamplesAPixel) {
  // One in eight is lit, over and over: the mean luminance is 1/8, and the divergences are those of
  // eight samples of which one is lit.
  Film film(1, 1,
            {.variance = true,
             .chi2 = true,
             .kl = true,
             .hellinger = true,
             .half = SampleHalf::alternate});
  std::vector<glm::vec3> samples(1000, glm::vec3(0.0f));
  for (std::size_t i = 0; i < samples.size(); i += 8) {
    samples[i] = glm::vec3(1.0f);
  }
  for (int i = 0; i < 10'000; ++i) {
    film.add(0, samples);
  }
  const double n = 1e7;
  const double mean = film.mean_luminance(0);
  EXPECT_NEAR(mean, 0.125, 1e-12);
  EXPECT_NEAR(film.spread(Divergence::chi2, 0) / n, 7.0 / 64.0, 1e-12);
  EXPECT_NEAR(film.spread(Divergence::kl, 0) / (n * mean), std::log(8.0), 1e-11);
  EXPECT_NEAR(film.spread(Divergence::hellinger, 0) / (n * std::sqrt(mean)), 1.0 - std::sqrt(0.125),
              1e-11);
  EXPECT_NEAR(film.variance_of_mean(0).y * (n - 1.0), 7.0 / 64.0, 1e-12);
  EXPECT_EQ(film.half(0).count, 5'000'000u);
  EXPECT_EQ(film.half(0).mean(), glm::vec3(0.25f)) << "all that are lit have even indices";
}

TEST(Film, IndicesOfHalvesCountRejectedSamples) {
  const std::vector<glm::vec3> samples{glm::vec3(1.0f), glm::vec3(nan),   glm::vec3(2.0f),
                                       glm::vec3(4.0f), glm::vec3(-1.0f), glm::vec3(8.0f)};
  Film film(1, 1, {.half = SampleHalf::alternate});
  // In pieces, as passes do.
  film.add(0, std::span(samples).first(3));
  film.add(0, std::span(samples).subspan(3));
  EXPECT_EQ(film.half(0).count, 2u);
  EXPECT_EQ(film.half(0).mean(), glm::vec3(1.5f));
  EXPECT_EQ(film.counts()[0], 4u);
}

TEST(Film, StatisticsCostNothingWhereUnused) {
  const std::vector<glm::vec3> samples(4, glm::vec3(1.0f));
  Film film(10, 10);
  film.add(0, samples);
  const std::size_t plain = film.bytes();
  EXPECT_EQ(plain, 100 * (3 * sizeof(float) + 2 * sizeof(std::uint32_t) + sizeof(glm::dvec3)));
  film.restart({.chi2 = true, .half = SampleHalf::class_a});
  film.add(0, samples);
  EXPECT_EQ(film.bytes(), plain + 100 * (2 * sizeof(double) + sizeof(RunningMean)));
  EXPECT_EQ(film.mean_luminance(0), 1.0);
  film.restart({});
  film.add(0, samples);
  EXPECT_EQ(film.bytes(), plain);
}

}  // namespace
}  // namespace quartet
