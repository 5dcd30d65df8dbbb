#include "renderer/adaptive/policies/plan_parts.h"
#include "renderer/adaptive/policies/policy_rows.h"

namespace quartet {
namespace {

/// Mitchell 1987: one sample everywhere, and after a single look eight more where it is needed.
void plan_two_level(const LaneSettings& settings, const PlanInput& input, Plan& plan) {
  if (input.pass == 0) {
    plan_everywhere(plan, chosen_samples(settings.policy.first, 1));
  } else {
    const std::uint16_t batch = chosen_samples(settings.policy.batch, usual_batch);
    plan_not_done(settings, input, plan, input.pass == 1 ? batch : 0);
  }
}

}  // namespace

constexpr PolicyRow two_level_policy{
    .key = PolicyId::two_level,
    .id = "two-level",
    .label = "two-level",
    .source = "Mitchell 1987: 1 sample everywhere, then once 8 more",
    .parameters = batch_parameters,
    .plan = plan_two_level};

}  // namespace quartet
