#include "renderer/adaptive/estimator.h"

#include "renderer/adaptive/window_kernels.h"
#include "renderer/table.h"

namespace quartet {
namespace {

constexpr std::string_view rigau =
    "Rigau, Feixas and Sbert 2003, Refinement Criteria Based on f-Divergences";
constexpr std::string_view tuned_by_eye = "tuned by eye against contrast in the 2021 report";

constexpr std::array table{
    Estimator{EstimatorId::contrast,
              "contrast",
              "Mitchell contrast",
              "contrast",
              "Mitchell 1987, Generating Antialiased Images at Low Sampling Densities",
              "Mitchell 1987",
              3,
              {0.4f, 0.3f, 0.6f},
              estimate_contrast},
    Estimator{EstimatorId::kl,
              "kl",
              "√ Kullback–Leibler",
              "radiance",
              rigau,
              tuned_by_eye,
              1,
              {0.005f, 0.0f, 0.0f},
              estimate_kl},
    Estimator{EstimatorId::chi2,
              "chi2",
              "√ χ²",
              "radiance",
              rigau,
              tuned_by_eye,
              1,
              {0.007f, 0.0f, 0.0f},
              estimate_chi2},
    Estimator{EstimatorId::hellinger,
              "hellinger",
              "√ Hellinger",
              "radiance",
              rigau,
              tuned_by_eye,
              1,
              {0.003f, 0.0f, 0.0f},
              estimate_hellinger},
    Estimator{EstimatorId::uniform,
              "uniform",
              "uniform",
              "",
              "every pixel alike: the baseline of every comparison",
              "",
              0,
              {},
              nullptr},
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
