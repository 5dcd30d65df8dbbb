#include "renderer/adaptive/estimators/sample_estimators.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "renderer/adaptive/estimators/quantiles.h"
#include "renderer/adaptive/estimators/spread.h"
#include "renderer/base/parallel.h"

namespace quartet {
namespace {

// Pixels handed to one thread at a time; a smaller piece costs more to hand out than it gains.
constexpr std::size_t grain = 1 << 12;

constexpr double not_judged = std::numeric_limits<double>::infinity();

float to_float(double error) {
  constexpr double largest = std::numeric_limits<float>::max();
  return float(error > largest && error < not_judged ? largest : error);
}

/// Writes error_of(pixel, n) for each pixel, n its samples, where it has at least `fewest`.
template <class ErrorOf>
void each_pixel(const EstimatorInput& input, std::span<float> error, std::uint32_t fewest,
                const ErrorOf& error_of) {
  assert(error.size() == input.film.size());
  parallel_for(error.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t n = input.film.counts()[i];
      error[i] = to_float(n < fewest ? not_judged : error_of(i, n));
    }
  });
}

template <class ErrorOf>
void each_judged_pixel(const EstimatorInput& input, std::span<float> error,
                       const ErrorOf& error_of) {
  each_pixel(input, error, 2, error_of);
}

void estimate_rigau(Divergence divergence, const EstimatorInput& input, std::span<float> error) {
  const Film& film = input.film;
  each_judged_pixel(input, error, [&](std::size_t i, std::uint32_t n) {
    return spread_error(divergence, film.spread(divergence, i), film.mean_luminance(i), double(n));
  });
}

/// Writes normalise(Σ abs(I − A), ΣI).
template <class Normalise>
void estimate_half(const EstimatorInput& input, std::span<float> error,
                   const Normalise& normalise) {
  const Film& film = input.film;
  each_judged_pixel(input, error, [&](std::size_t i, std::uint32_t) {
    const RunningMean& half = film.half(i);
    if (half.count == 0) {
      return not_judged;
    }
    // In single precision as the means are: of equal samples, both are that sample.
    const glm::vec3 a = half.mean();
    double difference = 0.0;
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
      const auto mean = double(film.mean(c)[i]);
      difference += std::abs(mean - double(a[c]));
      sum += mean;
    }
    return normalise(difference, sum);
  });
}

}  // namespace

void estimate_confidence(const EstimatorInput& input, std::span<float> error) {
  constexpr double darkest = 1e-3;
  const Film& film = input.film;
  each_judged_pixel(input, error, [&](std::size_t i, std::uint32_t n) {
    const double deviations = film.spread(Divergence::chi2, i);
    const double of_mean = std::sqrt(deviations / (double(n - 1) * double(n)));
    return student_t_975(n - 1) * of_mean / std::max(film.mean_luminance(i), darkest);
  });
}

void estimate_variance(const EstimatorInput& input, std::span<float> error) {
  const Film& film = input.film;
  each_judged_pixel(input, error, [&](std::size_t i, std::uint32_t n) {
    return film.spread(Divergence::chi2, i) / chi_square_05(n - 1) / double(n);
  });
}

void estimate_half_buffer(const EstimatorInput& input, std::span<float> error) {
  estimate_half(input, error, [](double difference, double sum) {
    return sum > 0.0 ? difference / std::sqrt(sum) : 0.0;
  });
}

void estimate_cycles(const EstimatorInput& input, std::span<float> error) {
  constexpr double threshold_factor = 5.0;
  estimate_half(input, error, [](double difference, double sum) {
    return difference / (1e-4 + (sum < 1.0 ? std::sqrt(sum) : sum)) / threshold_factor;
  });
}

std::uint32_t cycles_minimum(const Thresholds& thresholds) {
  const double least = std::ceil(16.0 / std::pow(double(thresholds[0]), 0.3));
  return std::uint32_t(std::clamp(least, 4.0, 1e6));
}

void estimate_rigau_kl(const EstimatorInput& input, std::span<float> error) {
  estimate_rigau(Divergence::kl, input, error);
}

void estimate_rigau_chi2(const EstimatorInput& input, std::span<float> error) {
  estimate_rigau(Divergence::chi2, input, error);
}

void estimate_rigau_hellinger(const EstimatorInput& input, std::span<float> error) {
  estimate_rigau(Divergence::hellinger, input, error);
}

void estimate_oracle(const EstimatorInput& input, std::span<float> error) {
  assert(input.reference.size() == input.film.size());
  const Film& film = input.film;
  each_pixel(input, error, 1, [&](std::size_t i, std::uint32_t) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double difference = double(film.mean(c)[i]) - double(input.reference[i][c]);
      sum += difference * difference;
    }
    return sum / 3.0;
  });
}

}  // namespace quartet
