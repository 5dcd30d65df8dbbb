#include "renderer/adaptive/policy.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "renderer/table.h"

namespace quartet {
namespace {

/// Marks pixels with an error above its threshold in any channel; returns how many.
std::uint64_t mark_exceeding(const SamplingPolicy& policy, std::span<const float> error,
                             std::vector<std::uint8_t>& exceeds) {
  const std::size_t pixels = exceeds.size();
  std::uint8_t* mark = exceeds.data();
  std::fill_n(mark, pixels, std::uint8_t(0));
  for (int c = 0; c < estimator(policy.estimator).channels; ++c) {
    const float threshold = policy.thresholds[std::size_t(c)];
    const float* plane = error.data() + std::size_t(c) * pixels;
#pragma omp simd
    for (std::size_t i = 0; i < pixels; ++i) {
      mark[i] = std::uint8_t(mark[i] | std::uint8_t(plane[i] > threshold));
    }
  }
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    count += mark[i];
  }
  return count;
}

/// votes[i] = marks in the 3 × 3 block around pixel i.
void count_votes(const std::vector<std::uint8_t>& marks, int width, int height,
                 std::vector<std::uint8_t>& votes) {
  const auto w = std::size_t(width);
  std::vector<std::uint8_t> column(w);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* here = marks.data() + std::size_t(y) * w;
    const std::uint8_t* above = y > 0 ? here - w : nullptr;
    const std::uint8_t* below = y + 1 < height ? here + w : nullptr;
    std::uint8_t* sum = column.data();
    std::copy_n(here, w, sum);
    for (const std::uint8_t* row : {above, below}) {
      if (row) {
#pragma omp simd
        for (std::size_t x = 0; x < w; ++x) {
          sum[x] = std::uint8_t(sum[x] + row[x]);
        }
      }
    }
    std::uint8_t* out = votes.data() + std::size_t(y) * w;
    std::copy_n(sum, w, out);
#pragma omp simd
    for (std::size_t x = 1; x < w; ++x) {
      out[x] = std::uint8_t(out[x] + sum[x - 1]);
    }
#pragma omp simd
    for (std::size_t x = 0; x < w - 1; ++x) {
      out[x] = std::uint8_t(out[x] + sum[x + 1]);
    }
  }
}

/// A uniform number in [0, 1) that belongs to (pixel, frame).
float dither(std::uint32_t pixel, std::uint32_t frame) {
  std::uint32_t x = pixel * 0x9e3779b9u + frame * 0x85ebca6bu;
  x ^= x >> 16;
  x *= 0x21f0aaadu;
  x ^= x >> 15;
  x *= 0x735a2d97u;
  x ^= x >> 15;
  return float(x >> 8) * 0x1p-24f;
}

constexpr int most_votes = 9;

/// The policy of the 2021 report: every pixel above its threshold votes for itself and its up to
/// eight neighbours, and a pixel gets one sample and then ⌊multiplier · votes⌋ more.
void plan_vote(const SamplingPolicy& policy, const PlanInput& input, Plan& plan) {
  const std::size_t pixels = plan.wanted.size();
  std::uint16_t* wanted = plan.wanted.data();
  if (input.frame == 0 || estimator(policy.estimator).channels == 0) {
    std::fill_n(wanted, pixels, std::uint16_t(1));
    return;
  }
  std::vector<std::uint8_t> marks(pixels);
  std::vector<std::uint8_t> votes(pixels);
  plan.refined = mark_exceeding(policy, input.error, marks);
  count_votes(marks, input.width, input.height, votes);
  const float multiplier = policy.allocation.multiplier;
  if (policy.allocation.stochastic_rounding) {
    for (std::size_t i = 0; i < pixels; ++i) {
      const float extra =
          std::floor(multiplier * float(votes[i]) + dither(std::uint32_t(i), input.frame));
      wanted[i] = std::uint16_t(1.0f + extra);
    }
    return;
  }
  std::array<std::uint16_t, most_votes + 1> samples;
  for (int v = 0; v <= most_votes; ++v) {
    samples[std::size_t(v)] = std::uint16_t(1.0f + std::floor(multiplier * float(v)));
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    wanted[i] = samples[votes[i]];
  }
}

constexpr std::array table{
    AllocationRow{AllocationId::vote, "vote", "vote", "the 2021 course report", plan_vote},
};

}  // namespace

SamplingPolicy default_policy(EstimatorId estimator_id) {
  SamplingPolicy policy;
  policy.estimator = estimator_id;
  policy.thresholds = estimator(estimator_id).default_thresholds;
  return policy;
}

std::span<const AllocationRow> allocations() {
  return table;
}

const AllocationRow& allocation(AllocationId key) {
  return row_of(allocations(), key);
}

const AllocationRow& find_allocation(std::string_view id) {
  return find_row(allocations(), id, "policy");
}

void plan_next(const SamplingPolicy& policy, const PlanInput& input, Plan& plan) {
  const std::size_t pixels = input.taken.size();
  plan.wanted.resize(pixels);
  plan.total = 0;
  plan.refined = 0;
  allocation(policy.allocation.kind).plan(policy, input, plan);
  std::uint16_t* wanted = plan.wanted.data();
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint32_t room =
        input.taken[i] < policy.max_spp ? policy.max_spp - input.taken[i] : 0;
    wanted[i] = std::uint16_t(std::min<std::uint32_t>(wanted[i], room));
    total += wanted[i];
  }
  plan.total = total;
}

}  // namespace quartet
