#pragma once

#include <memory>
#include <span>
#include <vector>

#include "renderer/adaptive/lab.h"
#include "renderer/measure/metrics.h"

namespace quartet {

/// The true error of each lane of a lab after each of its frames: film against reference, in one
/// metric. Not thread-safe.
class ErrorHistory {
 public:
  /// Forgets all; from now on against this reference, or against none if it is null.
  void measure(std::shared_ptr<const RadianceImage> reference, MetricId metric);

  const std::shared_ptr<const RadianceImage>& reference() const { return reference_; }
  MetricId metric() const { return metric_; }

  /// After a lab's lanes were changed or rewound: forgets what lies beyond their frames.
  void rewind(std::span<const Lane> lanes);
  /// After each frame that some lanes have run. Measures those; runs on the threads of the current
  /// TBB arena.
  void update(std::span<const Lane> lanes);

  /// Of a lane, one number a frame; empty without a reference.
  std::span<const double> of(std::size_t lane) const { return errors_[lane]; }

 private:
  std::shared_ptr<const RadianceImage> reference_;
  MetricId metric_ = MetricId::relmse;
  std::vector<std::vector<double>> errors_;
};

}  // namespace quartet
