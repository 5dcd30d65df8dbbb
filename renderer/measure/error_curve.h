#pragma once

#include <span>
#include <vector>

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

  /// The error at a cost; NaN where that is not between the first point and the last: how errors
  /// would go on depends on sampler, scene and bias, and nobody knows.
  double error_at(double cost) const;

  std::span<const Point> points() const { return points_; }

 private:
  std::vector<Point> points_;
};

}  // namespace quartet
