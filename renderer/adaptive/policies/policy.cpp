#include "renderer/adaptive/policies/policy.h"

#include <algorithm>
#include <atomic>

#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/mark_rows.h"
#include "renderer/adaptive/policies/policy_rows.h"
#include "renderer/base/parallel.h"
#include "renderer/base/table.h"

namespace quartet {
namespace {

/// Rows handed to one thread at a time; a smaller piece costs more to hand out than it gains.
constexpr std::size_t plan_grain_rows = 32;

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

/// Leaves of what a row wants what its pixels may still take; returns the sum, which is less than
/// 2³² because a row has at most 65536 pixels.
std::uint32_t keep_below_maximum(std::uint32_t maximum, const std::uint32_t* taken,
                                 std::span<std::uint16_t> row) {
  std::uint16_t* const wanted = row.data();
  const std::size_t width = row.size();
  std::uint32_t sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t x = 0; x < width; ++x) {
    const std::uint32_t room = std::max(maximum, taken[x]) - taken[x];
    const std::uint32_t samples = std::min<std::uint32_t>(wanted[x], room);
    wanted[x] = std::uint16_t(samples);
    sum += samples;
  }
  return sum;
}

/// As many samples of every pixel.
void plan_everywhere(const LaneSettings& settings, const PlanInput& input, std::uint16_t samples,
                     Plan& plan) {
  const auto width = std::size_t(input.width);
  std::atomic<std::uint64_t> total = 0;
  parallel_for(std::size_t(input.height), plan_grain_rows, [&](std::size_t begin, std::size_t end) {
    std::uint64_t wanted_here = 0;
    for (std::size_t y = begin; y < end; ++y) {
      const std::span row = std::span(plan.wanted).subspan(y * width, width);
      std::ranges::fill(row, samples);
      wanted_here += keep_below_maximum(settings.max_spp, input.taken.data() + y * width, row);
    }
    total += wanted_here;
  });
  plan.total = total;
  plan.not_done = plan.wanted.size();
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

std::uint64_t plan_row(const LaneSettings& settings, const PlanRow& row,
                       std::span<std::uint16_t> wanted) {
  policy(settings.policy.kind).plan(settings, row, wanted.data());
  return keep_below_maximum(settings.max_spp, row.taken.data(), wanted);
}

void plan_next(const LaneSettings& settings, const PlanInput& input, Plan& plan) {
  plan.wanted.resize(input.taken.size());
  if (estimator(settings.estimator).channels == 0) {
    plan_everywhere(settings, input, 1, plan);  // without an error there is nothing to choose by
    return;
  }
  if (input.pass == 0) {
    plan_everywhere(settings, input, policy(settings.policy.kind).first(settings.policy), plan);
    return;
  }
  const auto width = std::size_t(input.width);
  const PixelCriterion criterion(settings, input.error, input.taken);
  std::atomic<std::uint64_t> total = 0;
  std::atomic<std::uint64_t> not_done = 0;
  parallel_for(std::size_t(input.height), plan_grain_rows, [&](std::size_t begin, std::size_t end) {
    MarkRows marks(width, input.height);
    const auto mark = [&](int y) {
      if (marks.in_picture(y)) {
        mark_not_done(criterion, std::size_t(y) * width, marks.row(y));
      }
    };
    mark(int(begin) - 1);
    mark(int(begin));
    std::uint64_t wanted_here = 0;
    std::uint64_t marked = 0;
    for (std::size_t y = begin; y < end; ++y) {
      mark(int(y) + 1);
      marked += marks.count(int(y));
      const std::size_t first = y * width;
      wanted_here +=
          plan_row(settings, marks.plan_row(int(y), input.pass, input.taken.subspan(first, width)),
                   std::span(plan.wanted).subspan(first, width));
    }
    total += wanted_here;
    not_done += marked;
  });
  plan.total = total;
  plan.not_done = not_done;
}

}  // namespace quartet
