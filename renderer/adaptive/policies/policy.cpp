#include "renderer/adaptive/policies/policy.h"

#include <algorithm>
#include <atomic>

#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/plan_parts.h"
#include "renderer/adaptive/policies/policy_rows.h"
#include "renderer/base/parallel.h"
#include "renderer/base/table.h"

namespace quartet {
namespace {

// A part's samples are counted in 32 bits.
constexpr std::size_t part_pixels = 1 << 14;

const PolicyRow* row_of_policy(PolicyId key) {
  switch (key) {
    case PolicyId::vote:
      return &vote_policy;
    case PolicyId::two_level:
      return &two_level_policy;
    case PolicyId::batch:
      return &batch_policy;
    case PolicyId::converge:
      return &converge_policy;
  }
  return nullptr;
}

}  // namespace

std::span<const PolicyRow> policies() {
  static const std::vector<PolicyRow> table = table_of(row_of_policy);
  return table;
}

const PolicyRow& policy(PolicyId key) {
  return row_of(policies(), key);
}

const PolicyRow& find_policy(std::string_view id) {
  return find_row(policies(), id, "policy");
}

void plan_next(const LaneSettings& settings, const PlanInput& input, Plan& plan) {
  const std::size_t pixels = input.taken.size();
  plan.wanted.resize(pixels);
  plan.total = 0;
  plan.not_done = pixels;
  if (estimator(settings.estimator).channels == 0) {
    plan_everywhere(plan, 1);  // without an error there is nothing to choose by
  } else {
    policy(settings.policy.kind).plan(settings, input, plan);
  }
  std::atomic<std::uint64_t> total = 0;
  parallel_for((pixels + part_pixels - 1) / part_pixels, 1,
               [&](std::size_t first, std::size_t last) {
                 const std::uint32_t* taken = input.taken.data();
                 std::uint16_t* wanted = plan.wanted.data();
                 const std::uint32_t most = settings.max_spp;
                 for (std::size_t part = first; part < last; ++part) {
                   const std::size_t end = std::min((part + 1) * part_pixels, pixels);
                   std::uint32_t sum = 0;
#pragma omp simd reduction(+ : sum)
                   for (std::size_t i = part * part_pixels; i < end; ++i) {
                     const std::uint32_t room = std::max(most, taken[i]) - taken[i];
                     const std::uint32_t samples = std::min<std::uint32_t>(wanted[i], room);
                     wanted[i] = std::uint16_t(samples);
                     sum += samples;
                   }
                   total += sum;
                 }
               });
  plan.total = total;
}

}  // namespace quartet
