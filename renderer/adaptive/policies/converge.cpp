#include "renderer/adaptive/policies/plan_parts.h"
#include "renderer/adaptive/policies/policy_rows.h"

namespace quartet {
namespace {

/// As production renderers do it: no pixel is looked at before it has a minimum of samples, because
/// one lucky agreement of few would stop it for good; then batches, also for the neighbours of a
/// pixel that is not done.
void plan_converge(const LaneSettings& settings, const PlanInput& input, Plan& plan) {
  constexpr std::uint16_t minimum = 16;
  if (input.pass == 0) {
    plan_everywhere(plan, chosen_samples(settings.policy.first, minimum));
    return;
  }
  const auto width = std::size_t(input.width);
  const std::uint16_t own = chosen_samples(estimator(settings.estimator).look_every, usual_batch);
  const std::uint16_t batch = chosen_samples(settings.policy.batch, own);
  plan_rows(settings, input, plan, [&](std::size_t y, PlanMarks& marks, std::uint16_t* wanted) {
    const std::uint8_t* columns = marks.columns(int(y));
#pragma omp simd
    for (std::size_t x = 0; x < width; ++x) {
      const int votes = columns[x] + columns[x + 1] + columns[x + 2];
      wanted[x] = std::uint16_t(votes > 0 ? batch : 0);
    }
  });
}

}  // namespace

constexpr PolicyRow converge_policy{
    .key = PolicyId::converge,
    .id = "converge",
    .label = "converge",
    .source = "production renderers: 16 everywhere, then 8 more around each pixel not done",
    .parameters = batch_parameters,
    .plan = plan_converge};

}  // namespace quartet
