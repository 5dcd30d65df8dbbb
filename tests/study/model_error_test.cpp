#include "renderer/study/needs/model_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace quartet {
namespace {

/// Pictures of `value` with normal noise of these deviations: one that is `shared` by all models
/// with the seed, and one of its `own`.
ModelPictures noisy_pictures(float value, float shared, float own, std::uint32_t seeds,
                             std::uint32_t stream, std::uint32_t first = 0) {
  ModelPictures pictures;
  for (std::uint32_t k = 0; k < seeds; ++k) {
    std::mt19937 common(1000 + first + k);
    std::mt19937 alone(stream * 7919 + first + k);
    // One each: a distribution keeps half of what it draws for the next time.
    std::normal_distribution<float> of_all;
    std::normal_distribution<float> normal;
    RadianceImage picture(40, 30);
    for (glm::vec3& pixel : picture.pixels()) {
      pixel = glm::vec3(value + shared * of_all(common));
      pixel += glm::vec3(own * normal(alone), own * normal(alone), own * normal(alone));
    }
    pictures.seeds.push_back(std::move(picture));
  }
  return pictures;
}

const Metric& mse() {
  return metric(MetricId::mse);
}

TEST(ModelError, NoiseIsThatOfTheMean) {
  const ModelPictures whole = noisy_pictures(2.0f, 0.0f, 0.3f, 9, 1);
  const Interval noise = noise_of_mean(mse(), whole, 0.01);
  EXPECT_NEAR(noise.mean, 0.01, 0.0003);
  EXPECT_TRUE(noise.contains(0.01));
  const Interval root = noise_of_mean(metric(MetricId::rmse), whole, 0.01);
  EXPECT_NEAR(root.mean, 0.1, 0.002);
}

TEST(ModelError, NoiseIsTakenOff) {
  const ModelPictures whole = noisy_pictures(2.0f, 0.0f, 0.3f, 8, 1);
  const ModelPictures alike = noisy_pictures(2.0f, 0.0f, 0.3f, 8, 2);
  const ModelError none = error_of_model(mse(), whole, alike, 0.01);
  EXPECT_NEAR(none.noise, 2.0 * 0.09 / 8.0, 0.002) << "of both, of the means of 8";
  EXPECT_NEAR(none.error.mean, 0.0, 0.1 * none.noise);
  EXPECT_TRUE(none.error.contains(0.0));
  const ModelError off = error_of_model(mse(), whole, noisy_pictures(2.1f, 0.0f, 0.3f, 8, 2), 0.01);
  EXPECT_NEAR(off.error.mean, 0.01, 0.003);
  EXPECT_TRUE(off.error.contains(0.01)) << off.error.low << " to " << off.error.high;
  EXPECT_GT(off.error.low, 0.0);
  EXPECT_TRUE(off.energy.contains(0.05)) << off.energy.low << " to " << off.energy.high;
  const ModelError root =
      error_of_model(metric(MetricId::rmse), whole, noisy_pictures(2.1f, 0.0f, 0.3f, 8, 2), 0.01);
  EXPECT_NEAR(root.error.mean, 0.1, 0.015);
}

TEST(ModelError, WhatSeedsShareIsNoError) {
  const ModelPictures whole = noisy_pictures(2.0f, 0.5f, 0.0f, 4, 1);
  const ModelError same =
      error_of_model(mse(), whole, noisy_pictures(2.0f, 0.5f, 0.0f, 4, 2), 0.01);
  EXPECT_EQ(same.error.mean, 0.0);
  EXPECT_EQ(same.error.high, 0.0);
  EXPECT_EQ(same.noise, 0.0);
  EXPECT_DOUBLE_EQ(same.variance.mean, 1.0);
  const ModelError off =
      error_of_model(mse(), whole, noisy_pictures(2.25f, 0.5f, 0.0f, 4, 2), 0.01);
  EXPECT_NEAR(off.error.mean, 0.0625, 1e-5) << "whatever the noise that both have";
  EXPECT_NEAR(off.error.high, 0.0625, 1e-5);
}

TEST(ModelError, VarianceIsARatio) {
  const ModelError error = error_of_model(mse(), noisy_pictures(2.0f, 0.0f, 0.2f, 8, 1),
                                          noisy_pictures(2.0f, 0.0f, 0.4f, 8, 2), 0.01);
  EXPECT_NEAR(error.variance.mean, 4.0, 0.2);
  EXPECT_TRUE(error.variance.contains(4.0));
}

/// Intervals at 95 % miss no more than they may: of 200, one in 500 sets of right ones has more
/// than 21 misses (binomial).
TEST(ModelError, IntervalsHoldAsOftenAsTheySay) {
  int missed = 0;
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    const ModelError error =
        error_of_model(mse(), noisy_pictures(2.0f, 0.1f, 0.3f, 4, 1, 10 * trial),
                       noisy_pictures(2.05f, 0.1f, 0.3f, 4, 2, 10 * trial), 0.05);
    missed += error.error.contains(0.0025) ? 0 : 1;
  }
  EXPECT_LE(missed, 21);
}

}  // namespace
}  // namespace quartet
