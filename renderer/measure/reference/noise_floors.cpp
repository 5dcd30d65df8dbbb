#include "renderer/measure/reference/noise_floors.h"

#include <limits>

#include "renderer/measure/left_out.h"
#include "renderer/measure/reference/possible_truths.h"

namespace quartet {

double NoiseFloors::of(const Metric& row) {
  const RadianceImage& image = reference_.image;
  const auto& halves = reference_.halves;
  if (halves[0].empty() || reference_.spp < 2) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (row.floor_by_halves) {
    RadianceImage off = image;
    for (std::size_t i = 0; i < off.size(); ++i) {
      off.pixels()[i] += 0.5f * (halves[0].pixels()[i] - halves[1].pixels()[i]);
    }
    return compute_over_finite(row, off, image);
  }
  // Neighbours are those that the metric looks at together, or the nearest.
  const double sigma = row.looks_around ? 2.0 : 1.0;
  auto made = truths_.find(sigma);
  if (made == truths_.end()) {
    made = truths_.emplace(sigma, possible_truths(image, halves, sigma)).first;
  }
  const auto& [darker, brighter] = made->second;
  return 0.5 *
         (compute_over_finite(row, darker, image) + compute_over_finite(row, brighter, image));
}

}  // namespace quartet
