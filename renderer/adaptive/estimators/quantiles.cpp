#include "renderer/adaptive/estimators/quantiles.h"

#include <array>
#include <cmath>
#include <numbers>

namespace quartet {
namespace {

// Quantiles of the standard normal distribution.
constexpr double normal_975 = 1.959963984540054;
constexpr double normal_05 = -1.6448536269514722;

// Up to here quantiles are looked up; from here on their expansions hold.
constexpr std::uint32_t tabulated = 128;
using Table = std::array<double, tabulated>;

/// Probability that abs(T) < t: Abramowitz and Stegun 26.7.3 and 26.7.4, finite sums for whole
/// degrees of freedom.
double student_inside(double t, std::uint32_t freedom) {
  const double theta = std::atan(t / std::sqrt(double(freedom)));
  const double cosine = std::cos(theta);
  const bool odd = freedom % 2 == 1;
  double term = odd ? cosine : 1.0;
  double sum = freedom == 1 ? 0.0 : term;
  for (std::uint32_t k = odd ? 3 : 2; k + 2 <= freedom; k += 2) {
    term *= cosine * cosine * double(k - 1) / double(k);
    sum += term;
  }
  return odd ? 2.0 / std::numbers::pi * (theta + std::sin(theta) * sum) : std::sin(theta) * sum;
}

/// Probability that a chi-square variable is below x: the incomplete gamma function by its series,
/// Abramowitz and Stegun 6.5.29, of which all terms are positive.
double chi_square_below(double x, std::uint32_t freedom) {
  const double a = 0.5 * double(freedom);
  const double z = 0.5 * x;
  double term = 1.0 / a;
  double sum = term;
  for (double k = a + 1.0; term > 1e-17 * sum; k += 1.0) {
    term *= z / k;
    sum += term;
  }
  return sum * std::exp(a * std::log(z) - z - std::lgamma(a));
}

/// Where a rising function of (x, freedom) reaches a value, between 0 and `high`.
template <class Function>
double inverse(const Function& function, std::uint32_t freedom, double value, double high) {
  double low = 0.0;
  for (int i = 0; i < 64; ++i) {
    const double middle = 0.5 * (low + high);
    (function(middle, freedom) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

template <class Quantile>
Table table_of(const Quantile& quantile) {
  Table table;
  for (std::uint32_t freedom = 1; freedom < tabulated; ++freedom) {
    table[freedom] = quantile(freedom);
  }
  table[0] = table[1];
  return table;
}

}  // namespace

double student_t_975(std::uint32_t freedom) {
  static const Table table =
      table_of([](std::uint32_t nu) { return inverse(student_inside, nu, 0.95, 16.0); });
  if (freedom < tabulated) {
    return table[freedom];
  }
  // Abramowitz and Stegun 26.7.5.
  constexpr double x = normal_975;
  constexpr double x2 = x * x;
  constexpr double g1 = x * (x2 + 1.0) / 4.0;
  constexpr double g2 = x * ((5.0 * x2 + 16.0) * x2 + 3.0) / 96.0;
  constexpr double g3 = x * (((3.0 * x2 + 19.0) * x2 + 17.0) * x2 - 15.0) / 384.0;
  const double r = 1.0 / double(freedom);
  return x + r * (g1 + r * (g2 + r * g3));
}

double chi_square_05(std::uint32_t freedom) {
  static const Table table =
      table_of([](std::uint32_t nu) { return inverse(chi_square_below, nu, 0.05, double(nu)); });
  if (freedom < tabulated) {
    return table[freedom];
  }
  // Goldberg and Levine, "Approximate Formulas for the Percentage Points and Normalization of t and
  // chi-square", Annals of Mathematical Statistics 17, 1946: the expansion of Cornish and Fisher.
  constexpr double x = normal_05;
  constexpr double x2 = x * x;
  constexpr double c1 = x * std::numbers::sqrt2;
  constexpr double c2 = 2.0 / 3.0 * (x2 - 1.0);
  constexpr double c3 = x * (x2 - 7.0) / (9.0 * std::numbers::sqrt2);
  constexpr double c4 = -((6.0 * x2 + 14.0) * x2 - 32.0) / 405.0;
  constexpr double c5 = x * ((9.0 * x2 + 256.0) * x2 - 433.0) / (4860.0 * std::numbers::sqrt2);
  const double n = double(freedom);
  const double root = std::sqrt(n);
  return n + c1 * root + c2 + (c3 + (c4 + c5 / root) / root) / root;
}

}  // namespace quartet
