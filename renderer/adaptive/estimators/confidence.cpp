#include <algorithm>
#include <cmath>

#include "renderer/adaptive/estimators/each_pixel.h"
#include "renderer/adaptive/estimators/estimator_rows.h"
#include "renderer/adaptive/estimators/quantiles.h"

namespace quartet {
namespace {

/// Purgathofer, "A Statistical Method for Adaptive Stochastic Sampling", Computers & Graphics
/// 11(2), 1987: half the width of the 95 % confidence interval of the mean luminance over that
/// mean, t(0.975, n − 1) · s / √n / max(L̄, 1e-3). Student's t, because n is small at first; the
/// floor keeps black pixels from wanting samples for ever. Of replicates, the t of as many as there
/// are, and the variance that their means show in the place of s²/n.
void estimate_confidence(const EstimatorInput& input, std::span<float> error) {
  constexpr double darkest = 1e-3;
  const Film& film = input.film;
  each_known_variance(input, error, [&](std::size_t i, const auto& deviations, std::uint32_t n) {
    const auto [squares, freedom] = deviations;
    const double of_mean = std::sqrt(squares / (double(freedom) * double(n)));
    return student_t_975(freedom) * of_mean / std::max(film.mean_luminance(i), darkest);
  });
}

}  // namespace

constexpr Estimator confidence_estimator{
    .key = EstimatorId::confidence,
    .id = "confidence",
    .label = "95 % confidence",
    .unit = "relative",
    .source = "Purgathofer 1987, A Statistical Method for Adaptive Stochastic Sampling",
    .threshold_source = "5 % of the mean",
    .channels = 1,
    .default_thresholds = {0.05f, 0.0f, 0.0f},
    .estimate = estimate_confidence,
    .default_policy = PolicyId::batch,
    .needs = {.chi2 = true},
    .judges_variance = true,
    .assumes = "independent samples: Student's t of s/√n"};

}  // namespace quartet
