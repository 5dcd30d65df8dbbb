#include <algorithm>
#include <cmath>

#include "renderer/adaptive/estimators/each_pixel.h"
#include "renderer/adaptive/estimators/estimator_rows.h"

namespace quartet {
namespace {

/// Writes normalise(Σ abs(I − A), ΣI); infinite where the half A is empty.
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

/// Dammertz, Hanika, Keller and Lensch, "A Hierarchical Automatic Stopping Condition for Monte
/// Carlo Global Illumination", WSCG 2010, section 2.1, without its hierarchy: Σ abs(I − A) / √ΣI
/// over R, G, B, with I the mean of all samples and A that of every second one. 0 where I is black.
void estimate_half_buffer(const EstimatorInput& input, std::span<float> error) {
  estimate_half(input, error, [](double difference, double sum) {
    return sum > 0.0 ? difference / std::sqrt(sum) : 0.0;
  });
}

/// The same as Blender Cycles 4 has it (adaptive_sampling.h of its kernel): A is the mean of class
/// A (which Cycles doubles the sum of, the same for a whole number of fours), and the sum of the
/// differences is divided by 1e-4 + √ΣI where ΣI < 1, and by 1e-4 + ΣI above. Divided by the 5 by
/// which Cycles multiplies its threshold, so that thresholds here are those of Cycles.
void estimate_cycles(const EstimatorInput& input, std::span<float> error) {
  constexpr double threshold_factor = 5.0;
  estimate_half(input, error, [](double difference, double sum) {
    return difference / (1e-4 + (sum < 1.0 ? std::sqrt(sum) : sum)) / threshold_factor;
  });
}

/// Of Cycles too: a pixel is not done below max(4, ⌈16 / threshold^0.3⌉) samples.
std::uint32_t cycles_minimum(const Thresholds& thresholds) {
  const double least = std::ceil(16.0 / std::pow(double(thresholds[0]), 0.3));
  return std::uint32_t(std::clamp(least, 4.0, 1e6));
}

}  // namespace

constexpr Estimator half_buffer_estimator{
    .key = EstimatorId::half_buffer,
    .id = "half-buffer",
    .label = "half buffers",
    .unit = "√radiance",
    .source =
        "Dammertz, Hanika, Keller and Lensch 2010, A Hierarchical Automatic Stopping Condition for "
        "Monte Carlo Global Illumination",
    .threshold_source = "that of Cycles for the same error: five times 0.01",
    .channels = 1,
    .default_thresholds = {0.05f, 0.0f, 0.0f},
    .estimate = estimate_half_buffer,
    .default_policy = PolicyId::converge,
    .needs = {.half = SampleHalf::alternate},
    .assumes = "any samples whose halves are drawn alike"};

constexpr Estimator cycles_estimator{.key = EstimatorId::cycles,
                                     .id = "cycles",
                                     .label = "Cycles",
                                     .unit = "√radiance / 5",
                                     .source = "Blender Cycles, adaptive_sampling.h of its kernel",
                                     .threshold_source = "Blender Cycles",
                                     .channels = 1,
                                     .default_thresholds = {0.01f, 0.0f, 0.0f},
                                     .estimate = estimate_cycles,
                                     .default_policy = PolicyId::converge,
                                     .needs = {.half = SampleHalf::class_a},
                                     .minimum_samples = cycles_minimum,
                                     .look_every = 16,
                                     .assumes =
                                         "progressive multi-jittered samples: class A is half of "
                                         "every four"};

}  // namespace quartet
