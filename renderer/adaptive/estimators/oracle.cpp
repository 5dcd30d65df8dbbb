#include "renderer/adaptive/estimators/each_pixel.h"
#include "renderer/adaptive/estimators/estimator_rows.h"

namespace quartet {
namespace {

/// The true squared error against the reference, mean of R, G and B: what a perfect estimator
/// would know. Infinite only for a pixel without samples.
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

/// What one sample's squared error is in expectation, which stands in the place of the reference,
/// over the number of samples. It looks at no sample, so that nothing is stopped by luck.
void expect_oracle(const EstimatorInput& input, std::span<float> error) {
  assert(input.reference.size() == input.film.size());
  each_pixel(input, error, 1, [&](std::size_t i, std::uint32_t n) {
    return double(input.reference[i].x) / double(n);
  });
}

}  // namespace

constexpr Estimator oracle_estimator{
    .key = EstimatorId::oracle,
    .id = "oracle",
    .label = "oracle",
    .unit = "radiance²",
    .source = "the true squared error against a reference: what a perfect estimator would know",
    .threshold_source = "a true error of a hundredth of radiance",
    .channels = 1,
    .default_thresholds = {1e-4f, 0.0f, 0.0f},
    .estimate = estimate_oracle,
    .default_policy = PolicyId::batch,
    .needs_reference = true};

constexpr Estimator oracle_expected_estimator{
    .key = EstimatorId::oracle_expected,
    .id = "oracle",
    .label = "oracle of expected errors",
    .unit = "",
    .source = "the squared error that so many samples have in expectation",
    .threshold_source = "a tenth of what is true",
    .channels = 1,
    .default_thresholds = {1e-2f, 0.0f, 0.0f},
    .estimate = expect_oracle,
    .default_policy = PolicyId::batch,
    .needs_reference = true,
    .control = true};

}  // namespace quartet
