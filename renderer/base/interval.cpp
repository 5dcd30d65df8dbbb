#include "renderer/base/interval.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace quartet {
namespace {

/// The continued fraction of the incomplete beta function by the modified method of Lentz:
/// Numerical Recipes, third edition, section 6.4.
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  double c = 1.0;
  double d = 1.0 - (a + b) * x / (a + 1.0);
  d = 1.0 / (std::abs(d) < tiny ? tiny : d);
  double fraction = d;
  for (int m = 1; m < 1000; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    double change = 1.0;
    for (const double term : {even, odd}) {
      d = 1.0 + term * d;
      d = 1.0 / (std::abs(d) < tiny ? tiny : d);
      c = 1.0 + term / c;
      c = std::abs(c) < tiny ? tiny : c;
      change = c * d;
      fraction *= change;
    }
    if (std::abs(change - 1.0) < 1e-15) {
      break;
    }
  }
  return fraction;
}

/// The regularised incomplete beta function I_x(a, b).
double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0 || x >= 1.0) {
    return x <= 0.0 ? 0.0 : 1.0;
  }
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(a, b, x) / a
                                       : 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

double normal_quantile(double p) {
  double low = 0.0;
  double high = 40.0;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > p ? low : high) = middle;
  }
  return high;
}

/// Of the mean.
double standard_error(std::span<const double> values, double mean) {
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - mean) * (value - mean);
  }
  return std::sqrt(squares / (double(values.size()) * double(values.size() - 1)));
}

}  // namespace

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return sum / double(values.size());
}

double student_p(double t, int degrees) {
  return incomplete_beta(0.5 * degrees, 0.5, degrees / (degrees + t * t));
}

double student_quantile(double p, int degrees) {
  double low = 0.0;
  double high = 1.0;
  while (student_p(high, degrees) > p) {
    high *= 2.0;
  }
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    (student_p(middle, degrees) > p ? low : high) = middle;
  }
  return high;
}

double median(std::vector<double> values) {
  assert(!values.empty());
  if (std::ranges::any_of(values, [](double value) { return std::isnan(value); })) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return values.size() % 2 == 1 ? *middle
                                : 0.5 * (*std::max_element(values.begin(), middle) + *middle);
}

float largest_but(std::vector<float> values, std::size_t left_out) {
  assert(left_out < values.size());
  const auto place = values.end() - 1 - std::ptrdiff_t(left_out);
  std::ranges::nth_element(values, place);
  return *place;
}

Interval mean_interval(std::span<const double> values, double p) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double mean = mean_of(values);
  if (values.size() < 2) {
    return {mean, -infinity, infinity};
  }
  const double half = student_quantile(p, int(values.size()) - 1) * standard_error(values, mean);
  return {mean, mean - half, mean + half};
}

Interval geometric_interval(std::span<const double> values, double p) {
  std::vector<double> logarithms;
  logarithms.reserve(values.size());
  for (const double value : values) {
    logarithms.push_back(std::log(value));
  }
  const Interval interval = mean_interval(logarithms, p);
  return {std::exp(interval.mean), std::exp(interval.low), std::exp(interval.high)};
}

double mean_p(std::span<const double> values, double truth) {
  const double mean = mean_of(values);
  if (values.size() < 2) {
    return 1.0;
  }
  const double error = standard_error(values, mean);
  if (error == 0.0) {
    return mean == truth ? 1.0 : 0.0;
  }
  return student_p((mean - truth) / error, int(values.size()) - 1);
}

std::vector<double> ratio_pseudovalues(std::span<const double> numerators,
                                       std::span<const double> denominators) {
  assert(numerators.size() == denominators.size() && numerators.size() >= 2);
  const double count = double(numerators.size());
  const double above = count * mean_of(numerators);
  const double below = count * mean_of(denominators);
  std::vector<double> values;
  values.reserve(numerators.size());
  for (std::size_t i = 0; i < numerators.size(); ++i) {
    const double without = (above - numerators[i]) / (below - denominators[i]);
    values.push_back(count * above / below - (count - 1.0) * without);
  }
  return values;
}

Interval share_interval(double hits, double trials, double p) {
  if (trials <= 0.0) {
    return {0.0, 0.0, 1.0};
  }
  const double z = normal_quantile(p);
  const double share = hits / trials;
  const double middle = (share + z * z / (2.0 * trials)) / (1.0 + z * z / trials);
  const double half = z / (1.0 + z * z / trials) *
                      std::sqrt(share * (1.0 - share) / trials + z * z / (4.0 * trials * trials));
  return {share, std::max(0.0, std::min(share, middle - half)),
          std::min(1.0, std::max(share, middle + half))};
}

double sidak(double family, double tests) {
  return -std::expm1(std::log1p(-family) / tests);
}

}  // namespace quartet
