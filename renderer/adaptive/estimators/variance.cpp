#include "renderer/adaptive/estimators/each_pixel.h"
#include "renderer/adaptive/estimators/estimator_rows.h"
#include "renderer/adaptive/estimators/quantiles.h"

namespace quartet {
namespace {

/// Lee, Redner and Uselton, "Statistically Optimized Sampling for Distributed Ray Tracing",
/// SIGGRAPH 1985: what the variance of the mean luminance stays below with 95 % confidence, were
/// samples normally distributed, (n − 1) s² / χ²(0.05, n − 1) / n. Of replicates the same of what
/// their means show.
void estimate_variance(const EstimatorInput& input, std::span<float> error) {
  each_known_variance(input, error, [](std::size_t, const auto& deviations, std::uint32_t n) {
    return deviations.squares / chi_square_05(deviations.freedom) / double(n);
  });
}

}  // namespace

constexpr Estimator variance_estimator{
    .key = EstimatorId::variance,
    .id = "variance",
    .label = "variance bound",
    .unit = "radiance²",
    .source =
        "Lee, Redner and Uselton 1985, Statistically Optimized Sampling for Distributed Ray "
        "Tracing",
    .threshold_source = "a standard error of a hundredth of radiance",
    .channels = 1,
    .default_thresholds = {1e-4f, 0.0f, 0.0f},
    .estimate = estimate_variance,
    .default_policy = PolicyId::batch,
    .needs = {.chi2 = true},
    .judges_variance = true,
    .assumes = "independent samples, for its χ² test of s²/n; the paper then stratifies them"};

}  // namespace quartet
