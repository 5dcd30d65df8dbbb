#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/image/image.h"

namespace quartet {

/// What a film keeps beside the mean. Each costs memory and time only where it is asked for.
struct FilmStatistics {
  bool variance = false;  ///< sample variance per channel
  bool operator==(const FilmStatistics&) const = default;
};

/// The statistics of the samples that each pixel has taken. Planar, because the estimators run over
/// it in vectors. Sums are in double: exact enough at 10⁷ samples a pixel.
class Film {
 public:
  Film(int width, int height, FilmStatistics statistics = {});

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return counts_.size(); }
  FilmStatistics statistics() const { return statistics_; }

  /// Adds samples (linear radiance) to a pixel, in this order. A sample with a component that is
  /// negative or not finite does not enter any statistic; it is counted as rejected.
  void add(std::size_t pixel, std::span<const glm::vec3> samples);

  /// Mean radiance of one channel (0 red, 1 green, 2 blue) of every pixel; 0 before the first
  /// sample.
  std::span<const float> mean(int channel) const { return means_[std::size_t(channel)]; }
  /// Samples in the mean of every pixel.
  std::span<const std::uint32_t> counts() const { return counts_; }
  std::span<const std::uint32_t> rejected() const { return rejected_; }
  std::uint64_t total_rejected() const { return total_rejected_; }

  /// Unbiased estimate of the variance of a pixel's mean, a channel: s²/n; 0 below two samples.
  /// Needs FilmStatistics::variance.
  glm::dvec3 variance_of_mean(std::size_t pixel) const;

  RadianceImage image() const;

 private:
  int width_;
  int height_;
  FilmStatistics statistics_;
  std::array<std::vector<double>, 3> sums_;
  std::array<std::vector<float>, 3> means_;
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t> rejected_;
  std::uint64_t total_rejected_ = 0;
  /// Sums of squared deviations from the mean.
  std::vector<glm::dvec3> deviations_;
};

}  // namespace quartet
