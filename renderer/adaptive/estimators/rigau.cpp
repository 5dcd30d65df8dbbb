#include "renderer/adaptive/estimators/each_pixel.h"
#include "renderer/adaptive/estimators/estimator_rows.h"
#include "renderer/adaptive/estimators/spread.h"

namespace quartet {
namespace {

/// Rigau, Feixas and Sbert 2003, the divergences of window.h over the samples of the pixel.
void estimate_rigau(Divergence divergence, const EstimatorInput& input, std::span<float> error) {
  const Film& film = input.film;
  each_judged_pixel(input, error, [&](std::size_t i, std::uint32_t n) {
    return spread_error(divergence, film.spread(divergence, i), film.mean_luminance(i), double(n));
  });
}

void estimate_rigau_kl(const EstimatorInput& input, std::span<float> error) {
  estimate_rigau(Divergence::kl, input, error);
}

/// That of chi-square is √(s² (n − 1) / n) / n, and so the variance of the mean in another guise:
/// of replicates, s²/n is what their means show. The other two are no variances, and stay.
void estimate_rigau_chi2(const EstimatorInput& input, std::span<float> error) {
  const Film& film = input.film;
  each_known_variance(input, error, [&](std::size_t i, const auto& deviations, std::uint32_t n) {
    const auto [squares, freedom] = deviations;
    const double as_if_independent = squares * (double(n - 1) / double(freedom));
    return spread_error(Divergence::chi2, as_if_independent, film.mean_luminance(i), double(n));
  });
}

void estimate_rigau_hellinger(const EstimatorInput& input, std::span<float> error) {
  estimate_rigau(Divergence::hellinger, input, error);
}

constexpr std::string_view a_distribution =
    "any samples, as a distribution; the paper stratifies each batch";

constexpr std::string_view as_over_neighbours =
    "that of the same divergence over 3 × 3 pixel means, tuned by eye in the 2021 report";

}  // namespace

constexpr Estimator rigau_kl_estimator{.key = EstimatorId::rigau_kl,
                                       .id = "rigau-kl",
                                       .label = "√ KL of samples",
                                       .unit = "radiance",
                                       .source = rigau_2003,
                                       .threshold_source = as_over_neighbours,
                                       .channels = 1,
                                       .default_thresholds = {0.005f, 0.0f, 0.0f},
                                       .estimate = estimate_rigau_kl,
                                       .default_policy = PolicyId::batch,
                                       .needs = {.kl = true},
                                       .assumes = a_distribution};

constexpr Estimator rigau_chi2_estimator{
    .key = EstimatorId::rigau_chi2,
    .id = "rigau-chi2",
    .label = "√ χ² of samples",
    .unit = "radiance",
    .source = rigau_2003,
    .threshold_source = as_over_neighbours,
    .channels = 1,
    .default_thresholds = {0.007f, 0.0f, 0.0f},
    .estimate = estimate_rigau_chi2,
    .default_policy = PolicyId::batch,
    .needs = {.chi2 = true},
    .judges_variance = true,
    .assumes =
        "independent samples, being the standard error of their mean over √n; the paper stratifies "
        "each batch"};

constexpr Estimator rigau_hellinger_estimator{.key = EstimatorId::rigau_hellinger,
                                              .id = "rigau-hellinger",
                                              .label = "√ Hellinger of samples",
                                              .unit = "radiance",
                                              .source = rigau_2003,
                                              .threshold_source = as_over_neighbours,
                                              .channels = 1,
                                              .default_thresholds = {0.003f, 0.0f, 0.0f},
                                              .estimate = estimate_rigau_hellinger,
                                              .default_policy = PolicyId::batch,
                                              .needs = {.hellinger = true},
                                              .assumes = a_distribution};

}  // namespace quartet
