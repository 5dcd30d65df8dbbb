#pragma once

#include <algorithm>
#include <cmath>

namespace quartet::test {

/// The false-alarm rate each of `tests` independent tests may have so that all together stay at
/// `family`: Šidák, "Rectangular Confidence Regions for the Means of Multivariate Normal
/// Distributions", JASA 62, 1967.
inline double sidak_level(double family, double tests) {
  return -std::expm1(std::log1p(-family) / tests);
}

/// Probability that a standard normal lies at least this far from 0.
inline double two_sided_p(double z) {
  return std::erfc(std::abs(z) / std::sqrt(2.0));
}

/// Probability that Student's t lies at least this far from 0: Abramowitz and Stegun 26.7.4. An odd
/// number of degrees of freedom counts as the even one below.
inline double two_sided_student_p(double t, int degrees) {
  const int even = degrees - degrees % 2;
  const double angle = std::atan(std::abs(t) / std::sqrt(double(even)));
  const double cos2 = std::cos(angle) * std::cos(angle);
  double term = 1.0;
  double sum = 1.0;
  for (int i = 2; i < even; i += 2) {
    term *= cos2 * (i - 1.0) / i;
    sum += term;
  }
  return std::max(0.0, 1.0 - std::sin(angle) * sum);
}

/// Mean and spread of a stream of numbers: Welford 1962.
class Moments {
 public:
  void add(double x) {
    ++count_;
    const double delta = x - mean_;
    mean_ += delta / double(count_);
    squares_ += delta * (x - mean_);
  }
  double mean() const { return mean_; }
  double variance() const { return count_ > 1 ? squares_ / double(count_ - 1) : 0.0; }
  double variance_of_mean() const { return variance() / double(count_); }
  double standard_error() const { return std::sqrt(variance_of_mean()); }
  long count() const { return count_; }

 private:
  long count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

/// Pearson's correlation of a stream of pairs; `score()` is standard normal for many independent
/// pairs.
class Correlation {
 public:
  void add(double x, double y) {
    ++count_;
    const double dx = x - mean_x_;
    const double dy = y - mean_y_;
    mean_x_ += dx / count_;
    mean_y_ += dy / count_;
    xx_ += dx * (x - mean_x_);
    yy_ += dy * (y - mean_y_);
    xy_ += dx * (y - mean_y_);
  }
  double coefficient() const { return xy_ / std::sqrt(xx_ * yy_); }
  double score() const { return std::atanh(coefficient()) * std::sqrt(count_ - 3.0); }

 private:
  double count_ = 0.0;
  double mean_x_ = 0.0, mean_y_ = 0.0;
  double xx_ = 0.0, yy_ = 0.0, xy_ = 0.0;
};

}  // namespace quartet::test
