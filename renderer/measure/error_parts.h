#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace quartet {

/// The two parts of a mean of squared errors, such as MSE: what all pictures of a method have in
/// common, and what differs from seed to seed. Their sum is the mean error of the pictures.
struct ErrorParts {
  /// Of the mean picture, without the part that its own noise has in that, so that it is as often
  /// below as above 0 where there is no bias. Noise of the reference is in it.
  double squared_bias = 0.0;
  double variance = 0.0;
};

/// Adds up pictures of a method, one a seed, of which only their sum is kept.
class ErrorSums {
 public:
  /// What Metric::errors says of a picture; the same count each time.
  void add(std::span<const float> errors);

  std::size_t pictures() const { return pictures_; }
  ErrorParts parts() const;  ///< NaN of fewer than two pictures

 private:
  std::vector<float> sum_;
  double squares_ = 0.0;
  std::size_t pictures_ = 0;
};

}  // namespace quartet
