#include "renderer/adaptive/estimators/estimator.h"

#include <vector>

#include "renderer/adaptive/estimators/estimator_rows.h"
#include "renderer/base/table.h"

namespace quartet {
namespace {

const Estimator* row_of_estimator(EstimatorId key) {
  switch (key) {
    case EstimatorId::contrast:
      return &contrast_estimator;
    case EstimatorId::kl:
      return &kl_estimator;
    case EstimatorId::chi2:
      return &chi2_estimator;
    case EstimatorId::hellinger:
      return &hellinger_estimator;
    case EstimatorId::confidence:
      return &confidence_estimator;
    case EstimatorId::variance:
      return &variance_estimator;
    case EstimatorId::half_buffer:
      return &half_buffer_estimator;
    case EstimatorId::cycles:
      return &cycles_estimator;
    case EstimatorId::rigau_kl:
      return &rigau_kl_estimator;
    case EstimatorId::rigau_chi2:
      return &rigau_chi2_estimator;
    case EstimatorId::rigau_hellinger:
      return &rigau_hellinger_estimator;
    case EstimatorId::oracle:
      return &oracle_estimator;
    case EstimatorId::uniform:
      return &uniform_estimator;
    case EstimatorId::uniform_clamp:
      return &uniform_clamp_estimator;
  }
  return nullptr;
}

}  // namespace

std::span<const Estimator> estimators() {
  static const std::vector<Estimator> table = table_of(row_of_estimator);
  return table;
}

const Estimator& estimator(EstimatorId key) {
  return row_of(estimators(), key);
}

const Estimator& find_estimator(std::string_view id) {
  return find_row(estimators(), id, "estimator");
}

}  // namespace quartet
