#include <cmath>
#include <vector>

#include "renderer/measure/metrics/metric_rows.h"
#include "renderer/measure/metrics/terms.h"

namespace quartet {
namespace {

constexpr int regions_a_side = 8;

/// Where the region of a pixel stands in a list of them row by row.
std::size_t region_of(int x, int y, const RadianceImage& image) {
  const std::int64_t column = std::int64_t(x) * regions_a_side / image.width();
  const std::int64_t row = std::int64_t(y) * regions_a_side / image.height();
  return std::size_t(row * regions_a_side + column);
}

/// A region's pixels, added up.
struct Region {
  glm::dvec3 x{0.0};
  glm::dvec3 r{0.0};
  double pixels = 0.0;

  /// Channel by channel, over what it is compared with.
  glm::dvec3 relative_difference() const {
    const glm::dvec3 right = r / pixels;
    return (x / pixels - right) / sqrt(right * right + 0.01);
  }

  /// Noise of pixels that do not know of each other is averaged away within a region, by its number
  /// of pixels, with which the result is multiplied; light that is lost everywhere is not. So this
  /// is relMSE for noise, and as many times the squared bias as the region has pixels.
  double error() const {
    const glm::dvec3 off = relative_difference();
    const glm::dvec3 relative = off * off;
    return pixels * (relative.x + relative.y + relative.z) / 3.0;
  }
};

/// Row by row; of a picture with fewer pixels a side some are empty.
std::vector<Region> regions_of(const RadianceImage& test, const RadianceImage& reference) {
  require_comparable(test, reference);
  std::vector<Region> regions(std::size_t(regions_a_side) * regions_a_side);
  for (int y = 0; y < test.height(); ++y) {
    for (int x = 0; x < test.width(); ++x) {
      Region& region = regions[region_of(x, y, test)];
      region.x += glm::dvec3(test.at(x, y));
      region.r += glm::dvec3(reference.at(x, y));
      region.pixels += 1.0;
    }
  }
  return regions;
}

ScalarImage regional_map(const RadianceImage& test, const RadianceImage& reference) {
  const std::vector<Region> regions = regions_of(test, reference);
  ScalarImage map(test.width(), test.height());
  for (int y = 0; y < test.height(); ++y) {
    for (int x = 0; x < test.width(); ++x) {
      map.at(x, y) = float(regions[region_of(x, y, test)].error());
    }
  }
  return map;
}

double regional_error(const RadianceImage& test, const RadianceImage& reference) {
  double sum = 0.0;
  for (const Region& region : regions_of(test, reference)) {
    sum += region.pixels > 0.0 ? region.pixels * region.error() : 0.0;
  }
  return sum / double(test.size());
}

/// So that the mean of the squares of all regions, those that are empty too, is the metric.
std::vector<float> regional_errors(const RadianceImage& test, const RadianceImage& reference) {
  const std::vector<Region> regions = regions_of(test, reference);
  std::vector<float> errors;
  for (const Region& region : regions) {
    const double weight = region.pixels * std::sqrt(double(regions.size()) / double(test.size()));
    const glm::dvec3 off =
        region.pixels > 0.0 ? weight * region.relative_difference() : glm::dvec3(0.0);
    for (int c = 0; c < 3; ++c) {
      errors.push_back(float(off[c]));
    }
  }
  return errors;
}

}  // namespace

constexpr Metric relmse_regions_metric{
    .key = MetricId::relmse_regions,
    .id = "relmse_regions",
    .label = "relMSE of regions",
    .unit = "",
    .definition =
        "mean of n (x − r)²/(r² + 0.01) of the means of 8 × 8 regions of n pixels; noise "
        "counts as in relMSE, bias n times",
    .scale = MetricScale::squared_error,
    .looks_around = true,
    .floor_by_halves = true,
    .compute = regional_error,
    .map = regional_map,
    .map_quantity = "n (x − r)²/(r² + 0.01) of the pixel's region",
    .errors = regional_errors};

}  // namespace quartet
