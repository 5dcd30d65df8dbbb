#include "renderer/adaptive/estimators/estimator.h"

#include <algorithm>
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
    case EstimatorId::oracle_expected:
      return &oracle_expected_estimator;
    case EstimatorId::lottery:
      return &lottery_estimator;
    case EstimatorId::endless:
      return &endless_estimator;
  }
  return nullptr;
}

std::span<const Estimator> all_rows() {
  static const std::vector<Estimator> table = table_of(row_of_estimator);
  return table;
}

}  // namespace

std::span<const Estimator> estimators() {
  static const std::size_t offered =
      std::size_t(std::ranges::count(all_rows(), false, &Estimator::control));
  return all_rows().first(offered);
}

const Estimator& estimator(EstimatorId key) {
  return row_of(all_rows(), key);
}

const Estimator& find_estimator(std::string_view id) {
  return find_row(estimators(), id, "estimator");
}

}  // namespace quartet
