#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/plan_parts.h"
#include "renderer/adaptive/policies/policy_rows.h"

namespace quartet {
namespace {

std::uint16_t first_of_two_level(const Policy& policy) {
  return chosen_samples(policy.first, 1);
}

/// Mitchell 1987: one sample everywhere, and after a single look eight more where it is needed.
void plan_two_level(const LaneSettings& settings, const PlanRow& row, std::uint16_t* wanted) {
  const std::uint16_t batch = chosen_samples(settings.policy.batch, usual_batch);
  plan_not_done(row, row.pass == 1 ? batch : 0, wanted);
}

}  // namespace

constexpr PolicyRow two_level_policy{
    .key = PolicyId::two_level,
    .id = "two-level",
    .label = "two-level",
    .source = "Mitchell 1987: 1 sample everywhere, then once 8 more",
    .parameters = batch_parameters,
    .first = first_of_two_level,
    .plan = plan_two_level};

}  // namespace quartet
