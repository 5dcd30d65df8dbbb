#include "renderer/adaptive/film/replicates.h"

#include <numeric>

#include "renderer/base/image.h"

namespace quartet {

MeanVariance variance_of_mean(const Replicates& replicates) {
  const auto& means = replicates.means;
  const auto& counts = replicates.counts;
  const std::uint64_t n = std::accumulate(counts.begin(), counts.end(), std::uint64_t(0));
  std::array<double, sampler_replicates> coefficients{};
  double q = 0.0;
  std::size_t first = sampler_replicates;
  std::size_t half = sampler_replicates;  // the one that has half of all
  std::uint32_t sequences = 0;
  for (std::size_t r = sampler_replicates; r-- > 0;) {
    if (counts[r] == 0) {
      continue;
    }
    if (2 * std::uint64_t(counts[r]) > n) {
      return {};
    }
    first = r;
    ++sequences;
    if (2 * std::uint64_t(counts[r]) == n) {
      half = r;
      continue;
    }
    const double w = double(counts[r]) / double(n);
    coefficients[r] = w * w / (1.0 - 2.0 * w);
    q += coefficients[r];
  }
  if (sequences < 2) {
    return {};
  }
  // From one of them, so that equal means have no variance at all.
  glm::dvec3 moved(0.0);
  for (std::size_t r = 0; r < sampler_replicates; ++r) {
    moved += double(counts[r]) / double(n) * (means[r] - means[first]);
  }
  const glm::dvec3 mean = means[first] + moved;
  MeanVariance variance;
  variance.freedom = half < sampler_replicates ? 1 : sequences - 1;
  const auto add = [&](std::size_t r, double coefficient) {
    const glm::dvec3 d = means[r] - mean;
    const double l = luminance(d.r, d.g, d.b);
    variance.channels += coefficient * d * d;
    variance.luminance += coefficient * l * l;
  };
  if (half < sampler_replicates) {
    add(half, 1.0);
    return variance;
  }
  for (std::size_t r = 0; r < sampler_replicates; ++r) {
    if (counts[r] > 0) {
      add(r, coefficients[r] / (1.0 + q));
    }
  }
  return variance;
}

}  // namespace quartet
