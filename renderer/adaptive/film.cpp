#include "renderer/adaptive/film.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "renderer/trace/running_mean.h"

namespace quartet {

Film::Film(int width, int height, FilmStatistics statistics)
    : width_(width), height_(height), statistics_(statistics) {
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  for (std::vector<float>& plane : means_) {
    plane.assign(pixels, 0.0f);
  }
  counts_.assign(pixels, 0);
  rejected_.assign(pixels, 0);
  if (statistics.variance) {
    deviations_.assign(pixels, glm::dvec3(0.0));
  }
}

void Film::add(std::size_t pixel, std::span<const glm::vec3> samples) {
  keep_sums();
  RunningMean running{sums_[pixel], counts_[pixel]};
  for (const glm::vec3& sample : samples) {
    if (!acceptable(sample)) {
      ++rejected_[pixel];
      continue;
    }
    if (statistics_.variance && running.count > 0) {
      // Welford, "Note on a Method for Calculating Corrected Sums of Squares and Products",
      // Technometrics 4(3), 1962, in the form that needs only the sum so far.
      const double n = double(running.count);
      const glm::dvec3 d = n * glm::dvec3(sample) - running.sum;
      deviations_[pixel] += d * d / (n * (n + 1.0));
    }
    running.add(sample);
  }
  sums_[pixel] = running.sum;
  put(pixel, running.count, running.mean());
}

std::uint32_t Film::reject(std::size_t pixel, std::span<const glm::vec3> samples) {
  const auto bad = std::uint32_t(std::count_if(
      samples.begin(), samples.end(), [](const glm::vec3& sample) { return !acceptable(sample); }));
  rejected_[pixel] += bad;
  return bad;
}

void Film::keep_sums() {
  if (sums_.empty()) {
    sums_.assign(size(), glm::dvec3(0.0));
  }
}

void Film::restore_sum(std::size_t pixel, std::span<const glm::vec3> samples) {
  RunningMean running;
  for (const glm::vec3& sample : samples) {
    if (acceptable(sample)) {
      running.add(sample);
    }
  }
  assert(running.count == counts_[pixel]);
  sums_[pixel] = running.sum;
}

void Film::clear() {
  for (std::vector<float>& plane : means_) {
    std::fill(plane.begin(), plane.end(), 0.0f);
  }
  std::fill(counts_.begin(), counts_.end(), 0u);
  std::fill(rejected_.begin(), rejected_.end(), 0u);
  std::fill(deviations_.begin(), deviations_.end(), glm::dvec3(0.0));
  sums_.clear();
}

std::uint64_t Film::total_rejected() const {
  return std::accumulate(rejected_.begin(), rejected_.end(), std::uint64_t(0));
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

std::size_t Film::bytes() const {
  constexpr std::size_t per_pixel = 3 * sizeof(float) + 2 * sizeof(std::uint32_t);
  return size() * per_pixel + (sums_.size() + deviations_.size()) * sizeof(glm::dvec3);
}

}  // namespace quartet
