#pragma once

#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "renderer/adaptive/estimators/estimator.h"
#include "renderer/adaptive/estimators/pixel_window.h"
#include "renderer/adaptive/estimators/quantiles.h"

namespace quartet {

/// The samples of every pixel of a small picture, from which everything else follows.
struct SampledPicture {
  int width;
  int height;
  std::vector<std::vector<glm::vec3>> samples;
  std::vector<glm::vec3> truth;

  /// `radiance(pixel, index)`, with `count` samples a pixel.
  SampledPicture(int w, int h, std::size_t count, auto&& radiance)
      : width(w), height(h), samples(std::size_t(w * h)), truth(samples.size(), glm::vec3(0.25f)) {
    for (std::size_t pixel = 0; pixel < samples.size(); ++pixel) {
      for (std::size_t i = 0; i < count; ++i) {
        samples[pixel].push_back(radiance(pixel, i));
      }
    }
  }

  Film film(FilmStatistics statistics) const {
    Film film(width, height, statistics);
    for (std::size_t pixel = 0; pixel < samples.size(); ++pixel) {
      film.add(pixel, samples[pixel]);
    }
    return film;
  }

  /// Channels × pixels, by the row's own function.
  std::vector<float> errors(const Estimator& row) const {
    const Film shown = film(row.needs);
    std::vector<float> error(std::size_t(row.channels) * shown.size(), -1.0f);
    row.estimate({shown, truth}, error);
    return error;
  }
};

inline glm::dvec3 mean_of(const std::vector<glm::vec3>& samples) {
  glm::dvec3 sum(0.0);
  for (const glm::vec3& sample : samples) {
    sum += glm::dvec3(sample);
  }
  return sum / double(samples.size());
}

/// Double-precision brute force, straight from the definitions.
class BruteForce {
 public:
  explicit BruteForce(const SampledPicture& picture) : picture_(picture) {}

  /// Of a pixel, by the definition of an estimator; of a channel where it has three.
  double error(EstimatorId id, std::size_t pixel, int channel) const {
    const std::vector<glm::vec3>& samples = picture_.samples[pixel];
    switch (id) {
      case EstimatorId::uniform:
      case EstimatorId::uniform_clamp:
        return 0.0;
      case EstimatorId::contrast:
        return contrast<double>(neighbours(pixel)[std::size_t(channel)]);
      case EstimatorId::kl:
        return over_neighbours(Divergence::kl, pixel);
      case EstimatorId::chi2:
        return over_neighbours(Divergence::chi2, pixel);
      case EstimatorId::hellinger:
        return over_neighbours(Divergence::hellinger, pixel);
      case EstimatorId::confidence: {
        const auto n = double(samples.size());
        const double of_mean = std::sqrt(deviations(samples) / (n - 1.0) / n);
        return student_t_975(std::uint32_t(samples.size() - 1)) * of_mean /
               std::max(mean_luminance(samples), 1e-3);
      }
      case EstimatorId::variance: {
        const auto n = double(samples.size());
        return deviations(samples) / chi_square_05(std::uint32_t(samples.size() - 1)) / n;
      }
      case EstimatorId::half_buffer: {
        const auto [difference, sum] =
            halves(samples, [](std::uint32_t index) { return index % 2 == 0; });
        return sum > 0.0 ? difference / std::sqrt(sum) : 0.0;
      }
      case EstimatorId::cycles: {
        const auto [difference, sum] = halves(samples, [](std::uint32_t index) {
          return std::popcount(index & 0xaaaaaaaau) % 2 == 1;
        });
        return difference / (1e-4 + (sum < 1.0 ? std::sqrt(sum) : sum)) / 5.0;
      }
      case EstimatorId::rigau_kl:
        return over_samples(Divergence::kl, samples);
      case EstimatorId::rigau_chi2:
        return over_samples(Divergence::chi2, samples);
      case EstimatorId::rigau_hellinger:
        return over_samples(Divergence::hellinger, samples);
      case EstimatorId::oracle: {
        const glm::dvec3 d = mean_of(samples) - glm::dvec3(picture_.truth[pixel]);
        return glm::dot(d, d) / 3.0;
      }
      case EstimatorId::oracle_expected:
      case EstimatorId::lottery:
      case EstimatorId::endless:
        break;  // controls are not walked
    }
    return -1.0;
  }

 private:
  using Channels = std::array<std::vector<double>, 3>;

  static double luminance_of(const glm::dvec3& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
  }
  static double mean_luminance(const std::vector<glm::vec3>& samples) {
    return luminance_of(mean_of(samples));
  }
  static double deviations(const std::vector<glm::vec3>& samples) {
    const double mean = mean_luminance(samples);
    double sum = 0.0;
    for (const glm::vec3& sample : samples) {
      const double d = luminance_of(glm::dvec3(sample)) - mean;
      sum += d * d;
    }
    return sum;
  }

  static double divergence_of(Divergence divergence, const Channels& channels) {
    return divergence_error(divergence, PixelWindow<double>{channels[0], channels[1], channels[2]});
  }
  static double over_samples(Divergence divergence, const std::vector<glm::vec3>& samples) {
    Channels channels;
    for (const glm::vec3& sample : samples) {
      for (std::size_t c = 0; c < 3; ++c) {
        channels[c].push_back(sample[int(c)]);
      }
    }
    return divergence_of(divergence, channels);
  }
  Channels neighbours(std::size_t pixel) const {
    const int x = int(pixel) % picture_.width;
    const int y = int(pixel) / picture_.width;
    Channels channels;
    for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, picture_.height - 1); ++ny) {
      for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, picture_.width - 1); ++nx) {
        const glm::dvec3 mean = mean_of(picture_.samples[std::size_t(ny * picture_.width + nx)]);
        for (std::size_t c = 0; c < 3; ++c) {
          channels[c].push_back(mean[int(c)]);
        }
      }
    }
    return channels;
  }
  double over_neighbours(Divergence divergence, std::size_t pixel) const {
    return divergence_of(divergence, neighbours(pixel));
  }

  /// Σ abs(I − A) and ΣI.
  static std::pair<double, double> halves(const std::vector<glm::vec3>& samples, auto&& is_in) {
    std::vector<glm::vec3> half;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
      if (is_in(i)) {
        half.push_back(samples[i]);
      }
    }
    const glm::dvec3 all = mean_of(samples);
    const glm::dvec3 d = glm::abs(all - mean_of(half));
    return {d.x + d.y + d.z, all.x + all.y + all.z};
  }

  const SampledPicture& picture_;
};

}  // namespace quartet
