#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace quartet::test {

/// Upper regularised incomplete gamma function Q(a, x), by series or continued fraction: Abramowitz
/// and Stegun 6.5.29 and 6.5.31. Good to about 1e-12.
inline double upper_gamma(double a, double x) {
  if (x <= 0.0) {
    return 1.0;
  }
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a;
    double sum = term;
    for (double n = a + 1.0; term > sum * 1e-15; n += 1.0) {
      term *= x / n;
      sum += term;
    }
    return 1.0 - front * sum;
  }
  double b = x + 1.0 - a;
  double c = 1e300;
  double d = 1.0 / b;
  double fraction = d;
  for (int i = 1; i < 100000; ++i) {
    const double numerator = -i * (i - a);
    b += 2.0;
    d = 1.0 / (numerator * d + b);
    c = b + numerator / c;
    fraction *= c * d;
    if (std::abs(c * d - 1.0) < 1e-15) {
      break;
    }
  }
  return front * fraction;
}

struct ChiSquare {
  double statistic = 0.0;
  int degrees = 0;  ///< of freedom
  double p = 1.0;   ///< probability of a statistic at least this large

  std::string describe() const {
    return "chi-square " + std::to_string(statistic) + " with " + std::to_string(degrees) +
           " degrees of freedom, p = " + std::to_string(p);
  }
};

/// Pearson's test of counts against expected counts, which must have the same sum. Bins that expect
/// less than 5 are too coarse for the chi-square distribution and are pooled, the emptiest first.
inline ChiSquare chi_square_test(std::span<const double> observed,
                                 std::span<const double> expected) {
  constexpr double smallest = 5.0;
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  ChiSquare result;
  int bins = 0;
  double pooled_observed = 0.0;
  double pooled_expected = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    pooled_observed += observed[order[i]];
    pooled_expected += expected[order[i]];
    // What is left after the last full bin stays with it rather than being dropped.
    const bool last = i + 1 == order.size();
    if (pooled_expected >= smallest || (last && pooled_expected > 0.0)) {
      const double difference = pooled_observed - pooled_expected;
      result.statistic += difference * difference / pooled_expected;
      ++bins;
      pooled_observed = pooled_expected = 0.0;
    }
  }
  if (pooled_expected == 0.0 && pooled_observed > 0.0) {
    return {HUGE_VAL, 0, 0.0};
  }
  result.degrees = bins - 1;
  result.p = result.degrees > 0 ? upper_gamma(0.5 * result.degrees, 0.5 * result.statistic) : 1.0;
  return result;
}

}  // namespace quartet::test
