#include "renderer/adaptive/policies/policy_parameter.h"

#include <algorithm>
#include <vector>

#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/policy_rows.h"
#include "renderer/base/table.h"

namespace quartet {
namespace {

const PolicyParameter* row_of_parameter(PolicyParameterId key) {
  switch (key) {
    case PolicyParameterId::first:
      return &first_parameter;
    case PolicyParameterId::batch:
      return &batch_parameter;
    case PolicyParameterId::multiplier:
      return &multiplier_parameter;
    case PolicyParameterId::stochastic_rounding:
      return &stochastic_rounding_parameter;
  }
  return nullptr;
}

}  // namespace

std::span<const PolicyParameter> policy_parameters() {
  static const std::vector<PolicyParameter> table = table_of(row_of_parameter);
  return table;
}

const PolicyParameter& policy_parameter(PolicyParameterId key) {
  return row_of(policy_parameters(), key);
}

void copy_parameter(const PolicyParameter& row, const Policy& from, Policy& to) {
  std::visit([&](const auto& value) { to.*value.member = from.*value.member; }, row.value);
}

bool reads(const PolicyRow& row, PolicyParameterId parameter) {
  return std::ranges::find(row.parameters, parameter) != row.parameters.end();
}

bool reads(const LaneSettings& settings, PolicyParameterId parameter) {
  return estimator(settings.estimator).channels > 0 &&
         reads(policy(settings.policy.kind), parameter);
}

}  // namespace quartet
