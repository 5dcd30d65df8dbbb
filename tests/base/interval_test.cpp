#include "renderer/base/interval.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/trace/statistics.h"

namespace quartet::test {
namespace {

// Abramowitz and Stegun, table 26.10, and for one and two degrees the closed forms
// tan(π(1 − p)/2) and √(2/(p(2 − p)) − 2).
TEST(Interval, StudentQuantilesAreThoseOfTheTables) {
  const auto expect = [](double p, int degrees, double quantile) {
    EXPECT_NEAR(student_quantile(p, degrees), quantile, 5e-4) << p << " " << degrees;
  };
  expect(0.05, 3, 3.182);
  expect(0.05, 15, 2.131);
  expect(0.01, 7, 3.499);
  expect(0.01, 15, 2.947);
  expect(0.01, 120, 2.617);
  expect(0.001, 10, 4.587);
  for (const double p : {0.3, 0.05, 1e-3, 1e-6}) {
    EXPECT_NEAR(student_quantile(p, 1) / std::tan(0.5 * M_PI * (1.0 - p)), 1.0, 1e-6) << p;
    EXPECT_NEAR(student_quantile(p, 2) / std::sqrt(2.0 / (p * (2.0 - p)) - 2.0), 1.0, 1e-6) << p;
  }
}

TEST(Interval, ProbabilitiesAgreeWithTheFiniteSum) {
  for (const int degrees : {2, 4, 8, 30, 100}) {
    for (const double t : {0.0, 0.3, -1.0, 2.5, 6.0}) {
      EXPECT_NEAR(student_p(t, degrees), two_sided_student_p(t, degrees), 1e-10) << t;
    }
  }
}

// The standard error of 1, 2, 3, 4 is √(5/12), and t of three degrees at 95 % is 3.18245.
TEST(Interval, OfAMeanByHand) {
  const std::array values{1.0, 2.0, 3.0, 4.0};
  const double error = std::sqrt(5.0 / 12.0);
  const Interval interval = mean_interval(values, 0.05);
  EXPECT_DOUBLE_EQ(interval.mean, 2.5);
  EXPECT_NEAR(interval.low, 2.5 - 3.182446 * error, 1e-5);
  EXPECT_NEAR(interval.high, 2.5 + 3.182446 * error, 1e-5);
  EXPECT_NEAR(mean_p(values, 2.5 - 3.182446 * error), 0.05, 1e-6);
  EXPECT_NEAR(mean_p(values, 2.5 + 3.182446 * error), 0.05, 1e-6);
  EXPECT_DOUBLE_EQ(mean_of(values), 2.5);
}

TEST(Interval, MedianByHand) {
  EXPECT_EQ(median({7.0}), 7.0);
  EXPECT_EQ(median({9.0, 1.0, 4.0}), 4.0);
  EXPECT_EQ(median({8.0, 1.0, 2.0, 9.0}), 5.0);
  EXPECT_TRUE(std::isnan(median({1.0, std::nan(""), 2.0})));
}

TEST(Interval, LargestButByHand) {
  const std::vector<float> values{3.0f, 9.0f, 1.0f, 9.0f, 4.0f};
  EXPECT_EQ(largest_but(values, 0), 9.0f);
  EXPECT_EQ(largest_but(values, 2), 4.0f);
  EXPECT_EQ(largest_but(values, 4), 1.0f);
}

// 20 000 intervals at 90 % miss the truth 2 000 times, standard deviation 42; five of them: false
// alarms under 1e-6.
TEST(Interval, MissesTheTruthAsOftenAsItSays) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(3.0, 2.0);
  int missed = 0;
  int rejected = 0;
  for (int i = 0; i < 20000; ++i) {
    std::array<double, 6> values;
    for (double& value : values) {
      value = normal(random);
    }
    missed += mean_interval(values, 0.1).contains(3.0) ? 0 : 1;
    rejected += mean_p(values, 3.0) < 0.1 ? 1 : 0;
  }
  EXPECT_NEAR(missed, 2000, 212);
  EXPECT_EQ(missed, rejected);
}

// 4000 studies of 16 pairs of small pictures, six exponential pixels in each, whose means have
// the ratio 1: intervals at 95 % miss it 200 times, standard deviation 14; five of them and a tenth
// for skewness. The mean of 4000 has a standard error that is found from their spread; five of
// them. False alarms together under 2e-6.
TEST(Interval, OfARatioIsNotThatOfTheMeanOfRatios) {
  std::mt19937 random(11);
  std::exponential_distribution<double> pixel(1.0);
  const auto picture = [&] {
    double sum = 0.0;
    for (int i = 0; i < 6; ++i) {
      sum += pixel(random);
    }
    return sum / 6.0;
  };
  Moments means;
  Moments means_of_ratios;
  int missed = 0;
  int ratios_missed = 0;
  for (int study = 0; study < 4000; ++study) {
    std::array<double, 16> above;
    std::array<double, 16> below;
    std::array<double, 16> ratios;
    for (std::size_t k = 0; k < above.size(); ++k) {
      above[k] = picture();
      below[k] = picture();
      ratios[k] = above[k] / below[k];
    }
    const std::vector<double> values = ratio_pseudovalues(above, below);
    means.add(mean_of(values));
    missed += mean_interval(values, 0.05).contains(1.0) ? 0 : 1;
    means_of_ratios.add(mean_of(ratios));
    ratios_missed += mean_interval(ratios, 0.05).contains(1.0) ? 0 : 1;
  }
  EXPECT_NEAR(means.mean(), 1.0, 5.0 * means.standard_error());
  EXPECT_NEAR(missed, 200, 70 + 20);
  // E[1/U] of a mean of six is 6/5.
  EXPECT_NEAR(means_of_ratios.mean(), 1.2, 5.0 * means_of_ratios.standard_error());
  EXPECT_GT(ratios_missed, 290);
}

TEST(Interval, OfFewOrEqualValues) {
  const std::array one{2.0};
  EXPECT_TRUE(mean_interval(one, 0.01).contains(1e300));
  EXPECT_EQ(mean_p(one, 0.0), 1.0);
  const std::array equal{2.0, 2.0, 2.0};
  EXPECT_TRUE(mean_interval(equal, 0.01).contains(2.0));
  EXPECT_FALSE(mean_interval(equal, 0.01).contains(2.0001));
  EXPECT_EQ(mean_p(equal, 2.0), 1.0);
  EXPECT_EQ(mean_p(equal, 2.0001), 0.0);
}

// Wilson's interval of 0 in 10 at 95 % is [0, 0.278]; of 5 in 10 it is [0.237, 0.763].
TEST(Interval, OfAShareIsWilsons) {
  const Interval none = share_interval(0.0, 10.0, 0.05);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 0.2775, 1e-3);
  const Interval half = share_interval(5.0, 10.0, 0.05);
  EXPECT_NEAR(half.low, 0.2366, 1e-3);
  EXPECT_NEAR(half.high, 0.7634, 1e-3);
  EXPECT_EQ(share_interval(0.0, 0.0, 0.05).high, 1.0);
}

TEST(Interval, SidakIsTheRateOfEach) {
  EXPECT_NEAR(1.0 - std::pow(1.0 - sidak(0.01, 500.0), 500.0), 0.01, 1e-12);
  EXPECT_DOUBLE_EQ(sidak(0.01, 1.0), 0.01);
}

}  // namespace
}  // namespace quartet::test
