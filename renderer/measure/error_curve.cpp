#include "renderer/measure/error_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace quartet {

ErrorCurve::ErrorCurve(std::vector<Point> points) : points_(std::move(points)) {
  std::erase_if(points_, [](const Point& p) { return !(p.cost > 0.0 && p.error > 0.0); });
  std::ranges::sort(points_, {}, &Point::cost);
}

double ErrorCurve::error_at(double cost) const {
  if (points_.empty() || !(cost >= points_.front().cost && cost <= points_.back().cost)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto right = std::ranges::lower_bound(points_, cost, {}, &Point::cost);
  if (right == points_.begin()) {
    return right->error;
  }
  const Point& a = *(right - 1);
  const double share = std::log(cost / a.cost) / std::log(right->cost / a.cost);
  return a.error * std::pow(right->error / a.error, share);
}

}  // namespace quartet
