#include "renderer/measure/error_parts.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace quartet {

void ErrorSums::add(std::span<const float> errors) {
  assert(pictures_ == 0 || sum_.size() == errors.size());
  sum_.resize(errors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    sum_[i] += errors[i];
    squares_ += double(errors[i]) * double(errors[i]);
  }
  ++pictures_;
}

ErrorParts ErrorSums::parts() const {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (pictures_ < 2) {
    return {unknown, unknown};
  }
  const double n = double(pictures_);
  double squared_sum = 0.0;
  for (const float sum : sum_) {
    squared_sum += double(sum) * double(sum);
  }
  const double mean_error = squares_ / (n * double(sum_.size()));
  const double error_of_mean = squared_sum / (n * n * double(sum_.size()));
  // Not below 0, where rounding would bring it.
  const double variance = std::max(0.0, (mean_error - error_of_mean) * n / (n - 1.0));
  return {error_of_mean - variance / n, variance};
}

}  // namespace quartet
