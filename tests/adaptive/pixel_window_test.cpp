#include "renderer/adaptive/estimators/pixel_window.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/adaptive/golden_windows.h"

namespace quartet {
namespace {

/// A grey window.
struct Grey {
  std::vector<double> values;
  PixelWindow<double> window() const { return {values, values, values}; }
};

double error(Divergence divergence, const Grey& grey) {
  return divergence_error(divergence, grey.window());
}

/// The divergence itself, out of the error.
double divergence(Divergence which, const Grey& grey) {
  const double scaled =
      error(which, grey) * double(grey.values.size()) / grey.window().mean_luminance();
  return scaled * scaled;
}

TEST(PixelWindow, GoldenValues) {
  const auto windows = golden_windows();
  ASSERT_EQ(windows.size(), 17u);
  for (const GoldenWindow& golden : windows) {
    SCOPED_TRACE(golden.name);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(contrast<double>(golden.channels[c]), golden.contrast[c], 1e-12);
    }
    for (const Divergence which : all_divergences) {
      const double expected = golden.divergence(which);
      const double tolerance = expected < 1e-6 ? 1e-7 : 1e-5 * expected;
      EXPECT_NEAR(divergence_error(which, golden.window()), expected, tolerance);
    }
  }
}

TEST(PixelWindow, OneHot) {
  for (const std::size_t n : {4u, 6u, 9u}) {
    Grey grey{std::vector<double>(n, 0.0)};
    grey.values[1] = 3.0;
    EXPECT_NEAR(divergence(Divergence::kl, grey), std::log(double(n)), 1e-12);
    EXPECT_NEAR(divergence(Divergence::chi2, grey), double(n) - 1.0, 1e-12);
    EXPECT_NEAR(divergence(Divergence::hellinger, grey), 1.0 - 1.0 / std::sqrt(double(n)), 1e-12);
    EXPECT_EQ(contrast<double>(grey.values), 1.0);
  }
}

TEST(PixelWindow, Chi2IsPopulationDeviationOverN) {
  std::mt19937 random(1);
  std::exponential_distribution<double> radiance(1.0);
  for (int i = 0; i < 100; ++i) {
    Grey grey{std::vector<double>(9)};
    double sum = 0.0;
    double squares = 0.0;
    for (double& value : grey.values) {
      value = radiance(random);
      sum += value / 9.0;
      squares += value * value / 9.0;
    }
    EXPECT_NEAR(error(Divergence::chi2, grey), std::sqrt(squares - sum * sum) / 9.0, 1e-12);
  }
}

TEST(PixelWindow, SmallSpreadsStandInFixedRatios) {
  // KL ≈ CV²/2 and H ≈ CV²/8 with relative errors of the order of the spread itself.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> spread(-1e-4, 1e-4);
  for (int i = 0; i < 100; ++i) {
    Grey grey{std::vector<double>(9)};
    for (double& value : grey.values) {
      value = 1.0 + spread(random);
    }
    const double chi2 = error(Divergence::chi2, grey);
    EXPECT_NEAR(error(Divergence::kl, grey) / chi2, std::sqrt(0.5), 1e-3);
    EXPECT_NEAR(error(Divergence::hellinger, grey) / chi2, std::sqrt(0.125), 1e-3);
  }
}

TEST(PixelWindow, DivergencesIgnoreScaleAndErrorsFollowIt) {
  const Grey grey{{0.1, 0.2, 0.9, 0.0, 0.4, 0.4}};
  Grey bright = grey;
  for (double& value : bright.values) {
    value *= 8.0;
  }
  for (const Divergence which : all_divergences) {
    EXPECT_NEAR(divergence(which, bright), divergence(which, grey), 1e-12);
    EXPECT_NEAR(error(which, bright), 8.0 * error(which, grey), 1e-12);
  }
  EXPECT_EQ(contrast<double>(bright.values), contrast<double>(grey.values));
}

TEST(PixelWindow, RunningSumsGiveTheSame) {
  // What a pixel's own samples need to keep: ΣL, ΣL², ΣL ln L, Σ√L.
  std::mt19937 random(3);
  std::exponential_distribution<double> radiance(1.0);
  Grey grey{std::vector<double>(200)};
  double sum = 0.0, squares = 0.0, logs = 0.0, roots = 0.0;
  for (double& value : grey.values) {
    value = radiance(random);
    sum += value;
    squares += value * value;
    logs += value * std::log(value);
    roots += std::sqrt(value);
  }
  const double n = 200.0;
  EXPECT_NEAR(divergence(Divergence::chi2, grey), n * squares / (sum * sum) - 1.0, 1e-10);
  EXPECT_NEAR(divergence(Divergence::kl, grey), logs / sum - std::log(sum) + std::log(n), 1e-10);
  EXPECT_NEAR(divergence(Divergence::hellinger, grey), 1.0 - roots / std::sqrt(n * sum), 1e-10);
}

TEST(PixelWindow, NoLightIsNoError) {
  const Grey black{std::vector<double>(9, 0.0)};
  for (const Divergence which : all_divergences) {
    EXPECT_EQ(error(which, black), 0.0);
  }
  EXPECT_EQ(contrast<double>(black.values), 0.0);
}

}  // namespace
}  // namespace quartet
