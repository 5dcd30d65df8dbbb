#include "renderer/adaptive/policies/allocation_rows.h"
#include "renderer/adaptive/policies/plan_parts.h"

namespace quartet {
namespace {

/// Rigau, Feixas and Sbert 2003: eight samples everywhere, then eight more wherever the error is
/// above the threshold, until it is so nowhere.
void plan_batch(const LaneSettings& settings, const PlanInput& input, Plan& plan) {
  if (input.pass == 0) {
    plan_everywhere(plan, chosen_samples(settings.allocation.first, usual_batch));
  } else {
    plan_not_done(settings, input, plan, chosen_samples(settings.allocation.batch, usual_batch));
  }
}

}  // namespace

constexpr AllocationRow batch_allocation{
    .key = AllocationId::batch,
    .id = "batch",
    .label = "batch",
    .source = "Rigau, Feixas and Sbert 2003: 8 everywhere, then 8 more until done",
    .parameters = batch_parameters,
    .plan = plan_batch};

}  // namespace quartet
