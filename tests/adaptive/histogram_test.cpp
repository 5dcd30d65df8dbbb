#include "renderer/adaptive/histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "renderer/base/math/fast_log2.h"

namespace quartet {
namespace {

TEST(FastLog2, IsWithinItsBound) {
  for (float x = 1e-37f; x < 1e37f; x *= 1.001f) {
    ASSERT_NEAR(fast_log2(x), std::log2(double(x)), 5e-5 + 1e-7 * std::abs(std::log2(x))) << x;
  }
  EXPECT_EQ(fast_log2(1.0f), 0.0f);
  EXPECT_EQ(fast_log2(0.25f), -2.0f);
}

TEST(Histogram, OfSamplesHasABinACountWhileThatFits) {
  SampleHistogram histogram;
  fill_histogram(std::vector<std::uint32_t>{1, 5, 5, 0, 255}, histogram);
  EXPECT_EQ(histogram.width, 1u);
  ASSERT_EQ(histogram.pixels.size(), 256u);
  EXPECT_EQ(histogram.pixels[0], 1u);
  EXPECT_EQ(histogram.pixels[1], 1u);
  EXPECT_EQ(histogram.pixels[5], 2u);
  EXPECT_EQ(histogram.pixels[255], 1u);
}

TEST(Histogram, OfManySamplesHasWiderBins) {
  for (const std::uint32_t most : {256u, 1000u, 65536u, 4000000000u}) {
    SampleHistogram histogram;
    fill_histogram(std::vector<std::uint32_t>{0, most / 2, most}, histogram);
    EXPECT_LE(histogram.pixels.size(), SampleHistogram::most_bins);
    EXPECT_GT(histogram.pixels.size(), SampleHistogram::most_bins / 2);
    EXPECT_EQ(histogram.pixels[most / histogram.width], 1u);
    EXPECT_EQ(std::accumulate(histogram.pixels.begin(), histogram.pixels.end(), 0u), 3u);
  }
}

TEST(Histogram, OfErrorsPutsEachIntoItsBin) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-8.9, 4.9);
  std::vector<float> errors(20000);
  std::array<std::uint32_t, ErrorHistogram::bins> expected{};
  for (float& error : errors) {
    double position = 0.0;
    do {  // the edges are not exact
      error = float(std::pow(10.0, exponent(random)));
      position = (std::log10(double(error)) - ErrorHistogram::first_exponent) *
                 ErrorHistogram::bins_per_decade;
    } while (std::abs(position - std::round(position)) < 0.01);
    ++expected[std::size_t(position)];
  }
  ErrorHistogram histogram;
  fill_histogram(errors, histogram);
  EXPECT_EQ(histogram.pixels, expected);
  EXPECT_EQ(histogram.zero, 0u);
}

TEST(Histogram, OfErrorsLosesNoPixel) {
  ErrorHistogram histogram;
  fill_histogram(std::vector<float>{0.0f, 1e-30f, 1e-45f, 1e30f, 1.0f,
                                    std::numeric_limits<float>::infinity(), std::nanf("")},
                 histogram);
  EXPECT_EQ(histogram.zero, 2u);
  EXPECT_EQ(histogram.pixels.front(), 2u);
  EXPECT_EQ(histogram.pixels.back(), 1u);
  EXPECT_EQ(histogram.infinite, 1u);
  const int middle = -ErrorHistogram::first_exponent * ErrorHistogram::bins_per_decade;
  EXPECT_EQ(histogram.pixels[std::size_t(middle)], 1u);
  EXPECT_DOUBLE_EQ(ErrorHistogram::begin_of(middle), 1.0);
}

}  // namespace
}  // namespace quartet
