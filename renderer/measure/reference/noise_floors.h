#pragma once

#include <array>
#include <map>

#include "renderer/measure/reference/reference.h"

namespace quartet {

/// Reference::noise_floor() in several metrics: pictures that they look at together are made once.
/// For one thread; the reference must live as long.
class NoiseFloors {
 public:
  explicit NoiseFloors(const Reference& reference) : reference_(reference) {}

  double of(const Metric& row);

 private:
  const Reference& reference_;
  std::map<double, std::array<RadianceImage, 2>> truths_;  // possible_truths() by their sigma
};

}  // namespace quartet
