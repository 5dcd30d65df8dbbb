#pragma once

#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "renderer/study/stability/failure_case.h"
#include "renderer/study/stability/truth.h"

namespace quartet {

/// What uniform sampling with a trial's own seed gives for whatever another lane took.
class UniformRun {
 public:
  /// Numbers of a picture that samples taken evenly make; of none where there are none.
  struct Point {
    double mean_spp = 0.0;
    double mean_rays = 0.0;      ///< a pixel
    double regions = 0.0;        ///< MetricId::relmse_regions
    double region_energy = 0.0;  ///< see Outcome
  };

  UniformRun() = default;
  /// By what it cost, rising.
  explicit UniformRun(std::vector<Point> points) : points_(std::move(points)) {}

  /// Between two passes straight from one to the other; NaN before the first and past the last,
  /// and where it cost nothing: nobody traces rays for a distribution.
  Point at(double Point::*cost, double value) const;
  /// Of all samples that it took.
  const Point& last() const { return points_.back(); }

 private:
  std::vector<Point> points_;
};

class Lab;

/// Gives the lab this one lane and runs it to `spp` samples a pixel, out of what is stored as far
/// as that goes. Nothing if `stop` ended it.
std::optional<UniformRun> run_uniform(Lab& lab, std::uint32_t spp, const Truth& truth,
                                      const PixelRegion& region, const std::stop_token& stop);

}  // namespace quartet
