#pragma once

#include <span>
#include <vector>

#include "renderer/measure/metrics.h"

namespace quartet {

/// How the error of a method falls with what is spent on it, through measured points: straight
/// between them on logarithmic axes.
class ErrorCurve {
 public:
  struct Point {
    double cost = 0.0;   ///< seconds or samples, above 0
    double error = 0.0;  ///< above 0
  };

  ErrorCurve() = default;
  /// In rising order of cost; points without a positive cost and error are left out.
  explicit ErrorCurve(std::vector<Point> points);

  /// The error at a cost; beyond the points, that of a line of `slope_beyond` through the nearest
  /// one. NaN if there are no points.
  double error_at(double cost) const;

  std::span<const Point> points() const { return points_; }

  /// Of samples at random, whose mean squared error falls as one over their number.
  double slope_beyond = -1.0;

 private:
  std::vector<Point> points_;
};

/// Beyond the points: as a metric's errors fall with samples at random, −1 for squared errors, else
/// −½. Of decibels there is none that means anything.
double slope_of(const Metric& metric);

}  // namespace quartet
