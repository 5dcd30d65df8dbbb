#include "renderer/adaptive/policies/plan_parts.h"
#include "renderer/adaptive/policies/policy_rows.h"

namespace quartet {
namespace {

/// Rigau, Feixas and Sbert 2003: eight samples everywhere, then eight more wherever the error is
/// above the threshold, until it is so nowhere.
void plan_batch(const LaneSettings& settings, const PlanInput& input, Plan& plan) {
  if (input.pass == 0) {
    plan_everywhere(plan, chosen_samples(settings.policy.first, usual_batch));
  } else {
    plan_not_done(settings, input, plan, chosen_samples(settings.policy.batch, usual_batch));
  }
}

}  // namespace

constexpr PolicyRow batch_policy{
    .key = PolicyId::batch,
    .id = "batch",
    .label = "batch",
    .source = "Rigau, Feixas and Sbert 2003: 8 everywhere, then 8 more until done",
    .parameters = batch_parameters,
    .plan = plan_batch};

}  // namespace quartet
