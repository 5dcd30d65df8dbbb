#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/plan_parts.h"
#include "renderer/adaptive/policies/policy_rows.h"

namespace quartet {
namespace {

std::uint16_t first_of_batch(const Policy& policy) {
  return chosen_samples(policy.first, usual_batch);
}

/// Rigau, Feixas and Sbert 2003: eight samples everywhere, then eight more wherever the error is
/// above the threshold, until it is so nowhere.
void plan_batch(const LaneSettings& settings, const PlanRow& row, std::uint16_t* wanted) {
  plan_not_done(row, chosen_samples(settings.policy.batch, usual_batch), wanted);
}

}  // namespace

constexpr PolicyRow batch_policy{
    .key = PolicyId::batch,
    .id = "batch",
    .label = "batch",
    .source = "Rigau, Feixas and Sbert 2003: 8 everywhere, then 8 more until done",
    .parameters = batch_parameters,
    .first = first_of_batch,
    .plan = plan_batch};

}  // namespace quartet
