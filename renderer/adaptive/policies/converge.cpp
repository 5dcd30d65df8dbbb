#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/plan_parts.h"
#include "renderer/adaptive/policies/policy_rows.h"

namespace quartet {
namespace {

std::uint16_t first_of_converge(const Policy& policy) {
  constexpr std::uint16_t minimum = 16;
  return chosen_samples(policy.first, minimum);
}

/// As production renderers do it: no pixel is looked at before it has a minimum of samples, because
/// one lucky agreement of few would stop it for good; then batches, also for the neighbours of a
/// pixel that is not done.
void plan_converge(const LaneSettings& settings, const PlanRow& row, std::uint16_t* wanted) {
  const std::uint16_t own = chosen_samples(estimator(settings.estimator).look_every, usual_batch);
  const std::uint16_t batch = chosen_samples(settings.policy.batch, own);
#pragma omp simd
  for (std::size_t x = 0; x < row.width; ++x) {
    wanted[x] = std::uint16_t(votes_of(row, x) > 0 ? batch : 0);
  }
}

}  // namespace

constexpr PolicyRow converge_policy{
    .key = PolicyId::converge,
    .id = "converge",
    .label = "converge",
    .source = "production renderers: 16 everywhere, then 8 more around each pixel not done",
    .parameters = batch_parameters,
    .first = first_of_converge,
    .plan = plan_converge};

}  // namespace quartet
