#include "renderer/adaptive/estimators/estimator.h"

#include "renderer/adaptive/estimators/sample_estimators.h"
#include "renderer/adaptive/estimators/window_kernels.h"
#include "renderer/adaptive/policy.h"
#include "renderer/base/table.h"

namespace quartet {
namespace {

constexpr std::string_view rigau =
    "Rigau, Feixas and Sbert 2003, Refinement Criteria Based on f-Divergences";
constexpr std::string_view tuned_by_eye = "tuned by eye against contrast in the 2021 report";

constexpr std::string_view as_over_neighbours =
    "that of the same divergence over 3 × 3 pixel means, tuned by eye in the 2021 report";

constexpr FilmStatistics luminance_variance{.chi2 = true};

constexpr std::array table{
    Estimator{EstimatorId::contrast,
              "contrast",
              "Mitchell contrast",
              "contrast",
              "Mitchell 1987, Generating Antialiased Images at Low Sampling Densities",
              "Mitchell 1987",
              3,
              {0.4f, 0.3f, 0.6f},
              estimate_contrast,
              AllocationId::vote},
    Estimator{EstimatorId::kl,
              "kl",
              "√ Kullback–Leibler",
              "radiance",
              rigau,
              tuned_by_eye,
              1,
              {0.005f, 0.0f, 0.0f},
              estimate_kl,
              AllocationId::vote},
    Estimator{EstimatorId::chi2,
              "chi2",
              "√ χ²",
              "radiance",
              rigau,
              tuned_by_eye,
              1,
              {0.007f, 0.0f, 0.0f},
              estimate_chi2,
              AllocationId::vote},
    Estimator{EstimatorId::hellinger,
              "hellinger",
              "√ Hellinger",
              "radiance",
              rigau,
              tuned_by_eye,
              1,
              {0.003f, 0.0f, 0.0f},
              estimate_hellinger,
              AllocationId::vote},
    Estimator{EstimatorId::confidence,
              "confidence",
              "95 % confidence",
              "relative",
              "Purgathofer 1987, A Statistical Method for Adaptive Stochastic Sampling",
              "5 % of the mean",
              1,
              {0.05f, 0.0f, 0.0f},
              estimate_confidence,
              AllocationId::batch,
              luminance_variance},
    Estimator{EstimatorId::variance,
              "variance",
              "variance bound",
              "radiance²",
              "Lee, Redner and Uselton 1985, Statistically Optimized Sampling for Distributed Ray "
              "Tracing",
              "a standard error of a hundredth of radiance",
              1,
              {1e-4f, 0.0f, 0.0f},
              estimate_variance,
              AllocationId::batch,
              luminance_variance},
    Estimator{EstimatorId::half_buffer,
              "half-buffer",
              "half buffers",
              "√radiance",
              "Dammertz, Hanika, Keller and Lensch 2010, A Hierarchical Automatic Stopping "
              "Condition for Monte Carlo Global Illumination",
              "that of Cycles for the same error: five times 0.01",
              1,
              {0.05f, 0.0f, 0.0f},
              estimate_half_buffer,
              AllocationId::converge,
              {.half = SampleHalf::alternate}},
    Estimator{EstimatorId::cycles,
              "cycles",
              "Cycles",
              "√radiance / 5",
              "Blender Cycles, adaptive_sampling.h of its kernel",
              "Blender Cycles",
              1,
              {0.01f, 0.0f, 0.0f},
              estimate_cycles,
              AllocationId::converge,
              {.half = SampleHalf::class_a},
              false,
              cycles_minimum,
              16},
    Estimator{EstimatorId::rigau_kl,
              "rigau-kl",
              "√ KL of samples",
              "radiance",
              rigau,
              as_over_neighbours,
              1,
              {0.005f, 0.0f, 0.0f},
              estimate_rigau_kl,
              AllocationId::batch,
              {.kl = true}},
    Estimator{EstimatorId::rigau_chi2,
              "rigau-chi2",
              "√ χ² of samples",
              "radiance",
              rigau,
              as_over_neighbours,
              1,
              {0.007f, 0.0f, 0.0f},
              estimate_rigau_chi2,
              AllocationId::batch,
              {.chi2 = true}},
    Estimator{EstimatorId::rigau_hellinger,
              "rigau-hellinger",
              "√ Hellinger of samples",
              "radiance",
              rigau,
              as_over_neighbours,
              1,
              {0.003f, 0.0f, 0.0f},
              estimate_rigau_hellinger,
              AllocationId::batch,
              {.hellinger = true}},
    Estimator{EstimatorId::oracle,
              "oracle",
              "oracle",
              "radiance²",
              "the true squared error against a reference: what a perfect estimator would know",
              "a true error of a hundredth of radiance",
              1,
              {1e-4f, 0.0f, 0.0f},
              estimate_oracle,
              AllocationId::batch,
              {},
              true},
    Estimator{EstimatorId::uniform,
              "uniform",
              "uniform",
              "",
              "every pixel alike: the baseline of every comparison",
              "",
              0,
              {},
              nullptr,
              AllocationId::vote},
};

}  // namespace

std::span<const Estimator> estimators() {
  return table;
}

const Estimator& estimator(EstimatorId key) {
  return row_of(estimators(), key);
}

const Estimator& find_estimator(std::string_view id) {
  return find_row(estimators(), id, "estimator");
}

}  // namespace quartet
