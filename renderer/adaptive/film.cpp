#include "renderer/adaptive/film.h"

#include <cassert>
#include <limits>

namespace quartet {
namespace {

/// False for negative components, infinities and NaN.
bool acceptable(const glm::vec3& sample) {
  constexpr float largest = std::numeric_limits<float>::max();
  return sample.x >= 0.0f && sample.x <= largest && sample.y >= 0.0f && sample.y <= largest &&
         sample.z >= 0.0f && sample.z <= largest;
}

}  // namespace

Film::Film(int width, int height, FilmStatistics statistics)
    : width_(width), height_(height), statistics_(statistics) {
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  for (std::size_t c = 0; c < 3; ++c) {
    sums_[c].assign(pixels, 0.0);
    means_[c].assign(pixels, 0.0f);
  }
  counts_.assign(pixels, 0);
  rejected_.assign(pixels, 0);
  if (statistics.variance) {
    deviations_.assign(pixels, glm::dvec3(0.0));
  }
}

void Film::add(std::size_t pixel, std::span<const glm::vec3> samples) {
  glm::dvec3 sum(sums_[0][pixel], sums_[1][pixel], sums_[2][pixel]);
  std::uint32_t count = counts_[pixel];
  for (const glm::vec3& sample : samples) {
    if (!acceptable(sample)) {
      ++rejected_[pixel];
      ++total_rejected_;
      continue;
    }
    if (statistics_.variance && count > 0) {
      // Welford, "Note on a Method for Calculating Corrected Sums of Squares and Products",
      // Technometrics 4(3), 1962, in the form that needs only the sum so far.
      const double n = double(count);
      const glm::dvec3 d = n * glm::dvec3(sample) - sum;
      deviations_[pixel] += d * d / (n * (n + 1.0));
    }
    sum += glm::dvec3(sample);
    ++count;
  }
  counts_[pixel] = count;
  const double weight = count > 0 ? 1.0 / double(count) : 0.0;
  for (int c = 0; c < 3; ++c) {
    sums_[std::size_t(c)][pixel] = sum[c];
    means_[std::size_t(c)][pixel] = float(sum[c] * weight);
  }
}

glm::dvec3 Film::variance_of_mean(std::size_t pixel) const {
  assert(statistics_.variance);
  const double n = counts_[pixel];
  return n < 2.0 ? glm::dvec3(0.0) : deviations_[pixel] / ((n - 1.0) * n);
}

RadianceImage Film::image() const {
  RadianceImage image(width_, height_);
  for (std::size_t i = 0; i < size(); ++i) {
    image.pixels()[i] = {means_[0][i], means_[1][i], means_[2][i]};
  }
  return image;
}

}  // namespace quartet
