#include "renderer/adaptive/policy.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "renderer/adaptive/pixel_state.h"
#include "renderer/base/parallel.h"
#include "renderer/base/table.h"

namespace quartet {
namespace {

// Work handed to one thread at a time; a smaller piece costs more to hand out than it gains.
constexpr std::size_t plan_grain_rows = 32;
// A part's samples are counted in 32 bits.
constexpr std::size_t part_pixels = 1 << 14;

/// Sum of a few thousand values, each at most 255, in vectors.
std::uint32_t sum_of(const std::uint8_t* values, std::size_t count) {
  std::uint32_t sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < count; ++i) {
    sum += values[i];
  }
  return sum;
}

/// The pixels of each row that are not done, kept for as long as rows nearby count them.
class Marks {
 public:
  Marks(const SamplingPolicy& policy, const PlanInput& input)
      : criterion_(policy, input.error, input.taken),
        width_(std::size_t(input.width)),
        height_(input.height),
        marks_(4 * width_ + 2) {}

  /// Marks the pixels of a row that are not done; none of a row outside the picture. The two rows
  /// marked before are still there.
  void mark(int y) {
    if (y < 0 || y >= height_) {
      std::fill_n(marks(y), width_, std::uint8_t(0));
    } else {
      mark_not_done(criterion_, std::size_t(y) * width_, {marks(y), width_});
    }
  }

  std::uint32_t count(int y) { return sum_of(row(y), width_); }

  /// 1 for each pixel of a row that is marked, 0 for the others.
  const std::uint8_t* row(int y) { return marks(y); }

  /// Marks in the three rows around row y, with a column of zeros to the left and to the right: the
  /// votes of pixel x are the sum of elements x … x + 2.
  const std::uint8_t* columns(int y) {
    const std::uint8_t* above = marks(y - 1);
    const std::uint8_t* here = marks(y);
    const std::uint8_t* below = marks(y + 1);
    std::uint8_t* sum = marks_.data() + 3 * width_ + 1;
#pragma omp simd
    for (std::size_t x = 0; x < width_; ++x) {
      sum[x] = std::uint8_t(above[x] + here[x] + below[x]);
    }
    return sum - 1;
  }

 private:
  std::uint8_t* marks(int y) {
    return marks_.data() + std::size_t(y + 3) % 3 * width_;
  }

  PixelCriterion criterion_;
  std::size_t width_;
  int height_;
  std::vector<std::uint8_t> marks_;  // three rows and their sum
};

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

/// Marks and counts the pixels that are not done, and calls row(y, marks, wanted) for each row of
/// the picture, from several threads.
template <class Row>
void plan_rows(const SamplingPolicy& policy, const PlanInput& input, Plan& plan, const Row& row) {
  const auto width = std::size_t(input.width);
  std::atomic<std::uint64_t> not_done = 0;
  parallel_for(std::size_t(input.height), plan_grain_rows, [&](std::size_t begin, std::size_t end) {
    Marks marks(policy, input);
    marks.mark(int(begin) - 1);
    marks.mark(int(begin));
    std::uint64_t marked = 0;
    for (std::size_t y = begin; y < end; ++y) {
      marks.mark(int(y) + 1);
      marked += marks.count(int(y));
      row(y, marks, plan.wanted.data() + y * width);
    }
    not_done += marked;
  });
  plan.not_done = not_done;
}

void plan_everywhere(Plan& plan, std::uint16_t samples) {
  std::fill(plan.wanted.begin(), plan.wanted.end(), samples);
}

/// The policy of the 2021 report: every pixel that is not done votes for itself and its up to
/// eight neighbours, and a pixel gets one sample and then ⌊multiplier · votes⌋ more.
void plan_vote(const SamplingPolicy& policy, const PlanInput& input, Plan& plan) {
  if (input.frame == 0) {
    plan_everywhere(plan, 1);
    return;
  }
  const auto width = std::size_t(input.width);
  const float multiplier = policy.allocation.multiplier;
  plan_rows(policy, input, plan, [&](std::size_t y, Marks& marks, std::uint16_t* wanted) {
    const std::uint8_t* columns = marks.columns(int(y));
    // Through int, for which there are vectors; it rounds down because no term is negative.
    if (policy.allocation.stochastic_rounding) {
      const auto first = std::uint32_t(y * width);
#pragma omp simd
      for (std::size_t x = 0; x < width; ++x) {
        const int votes = columns[x] + columns[x + 1] + columns[x + 2];
        const float offset = dither(first + std::uint32_t(x), input.frame);
        wanted[x] = std::uint16_t(1 + int(multiplier * float(votes) + offset));
      }
    } else {
#pragma omp simd
      for (std::size_t x = 0; x < width; ++x) {
        const int votes = columns[x] + columns[x + 1] + columns[x + 2];
        wanted[x] = std::uint16_t(1 + int(multiplier * float(votes)));
      }
    }
  });
}

/// What the policies below give a pixel at once: one pass of the sampler's stratification.
constexpr std::uint16_t batch_samples = 8;

std::uint16_t chosen(std::uint16_t asked, std::uint16_t otherwise) {
  return asked > 0 ? asked : otherwise;
}

/// As many samples for every pixel that is not done, none for the others.
void plan_not_done(const SamplingPolicy& policy, const PlanInput& input, Plan& plan,
                   std::uint16_t samples) {
  const auto width = std::size_t(input.width);
  plan_rows(policy, input, plan, [&](std::size_t y, Marks& marks, std::uint16_t* wanted) {
    const std::uint8_t* row = marks.row(int(y));
#pragma omp simd
    for (std::size_t x = 0; x < width; ++x) {
      wanted[x] = std::uint16_t(row[x] * samples);
    }
  });
}

/// Mitchell 1987: one sample everywhere, and after a single look eight more where it is needed.
void plan_two_level(const SamplingPolicy& policy, const PlanInput& input, Plan& plan) {
  if (input.frame == 0) {
    plan_everywhere(plan, chosen(policy.allocation.first, 1));
  } else {
    const std::uint16_t batch = chosen(policy.allocation.batch, batch_samples);
    plan_not_done(policy, input, plan, input.frame == 1 ? batch : 0);
  }
}

/// Rigau, Feixas and Sbert 2003: eight samples everywhere, then eight more wherever the error is
/// above the threshold, until it is so nowhere.
void plan_batch(const SamplingPolicy& policy, const PlanInput& input, Plan& plan) {
  if (input.frame == 0) {
    plan_everywhere(plan, chosen(policy.allocation.first, batch_samples));
  } else {
    plan_not_done(policy, input, plan, chosen(policy.allocation.batch, batch_samples));
  }
}

/// As production renderers do it: no pixel is looked at before it has a minimum of samples, because
/// one lucky agreement of few would stop it for good; then batches, also for the neighbours of a
/// pixel that is not done.
void plan_converge(const SamplingPolicy& policy, const PlanInput& input, Plan& plan) {
  constexpr std::uint16_t minimum = 16;
  if (input.frame == 0) {
    plan_everywhere(plan, chosen(policy.allocation.first, minimum));
    return;
  }
  const auto width = std::size_t(input.width);
  const std::uint16_t own = chosen(estimator(policy.estimator).look_every, batch_samples);
  const std::uint16_t batch = chosen(policy.allocation.batch, own);
  plan_rows(policy, input, plan, [&](std::size_t y, Marks& marks, std::uint16_t* wanted) {
    const std::uint8_t* columns = marks.columns(int(y));
#pragma omp simd
    for (std::size_t x = 0; x < width; ++x) {
      const int votes = columns[x] + columns[x + 1] + columns[x + 2];
      wanted[x] = std::uint16_t(votes > 0 ? batch : 0);
    }
  });
}

constexpr AllocationFields vote_fields{.multiplier = true};
constexpr AllocationFields batch_fields{.first = true, .batch = true};

constexpr std::array allocation_table{
    AllocationRow{AllocationId::vote, "vote", "vote", "the 2021 course report", vote_fields,
                  plan_vote},
    AllocationRow{AllocationId::two_level, "two-level", "two-level",
                  "Mitchell 1987: 1 sample everywhere, then once 8 more", batch_fields,
                  plan_two_level},
    AllocationRow{AllocationId::batch, "batch", "batch",
                  "Rigau, Feixas and Sbert 2003: 8 everywhere, then 8 more until done",
                  batch_fields, plan_batch},
    AllocationRow{AllocationId::converge, "converge", "converge",
                  "production renderers: 16 everywhere, then 8 more around each pixel not done",
                  batch_fields, plan_converge},
};

constexpr std::array use_table{
    SampleUseRow{SampleUse::reuse, "reuse", "reuse",
                 "the samples that decide are the picture: the 2021 report's way, biased (Kirk and "
                 "Arvo 1991)"},
    SampleUseRow{
        SampleUse::unbiased, "unbiased", "unbiased",
        "a pilot run with another seed decides, and is thrown away: unbiased, at twice the "
        "samples (Kirk and Arvo 1991)"},
};

}  // namespace

std::uint32_t minimum_samples(const SamplingPolicy& policy) {
  const auto minimum = estimator(policy.estimator).minimum_samples;
  return minimum ? minimum(policy.thresholds) : 0;
}

SamplingPolicy default_policy(EstimatorId estimator_id) {
  SamplingPolicy policy;
  policy.estimator = estimator_id;
  const Estimator& row = estimator(estimator_id);
  policy.thresholds = row.default_thresholds;
  policy.allocation.kind = row.default_allocation;
  return policy;
}

std::span<const AllocationRow> allocations() {
  return allocation_table;
}

const AllocationRow& allocation(AllocationId key) {
  return row_of(allocations(), key);
}

const AllocationRow& find_allocation(std::string_view id) {
  return find_row(allocations(), id, "policy");
}

AllocationFields fields_read(const SamplingPolicy& policy) {
  return estimator(policy.estimator).channels == 0 ? AllocationFields{}
                                                   : allocation(policy.allocation.kind).reads;
}

std::span<const SampleUseRow> sample_uses() {
  return use_table;
}

const SampleUseRow& sample_use(SampleUse key) {
  return row_of(sample_uses(), key);
}

const SampleUseRow& find_sample_use(std::string_view id) {
  return find_row(sample_uses(), id, "mode");
}

void plan_next(const SamplingPolicy& policy, const PlanInput& input, Plan& plan) {
  const std::size_t pixels = input.taken.size();
  plan.wanted.resize(pixels);
  plan.total = 0;
  plan.not_done = pixels;
  if (estimator(policy.estimator).channels == 0) {
    plan_everywhere(plan, 1);  // without an error there is nothing to choose by
  } else {
    allocation(policy.allocation.kind).plan(policy, input, plan);
  }
  std::atomic<std::uint64_t> total = 0;
  parallel_for((pixels + part_pixels - 1) / part_pixels, 1,
               [&](std::size_t first, std::size_t last) {
                 const std::uint32_t* taken = input.taken.data();
                 std::uint16_t* wanted = plan.wanted.data();
                 const std::uint32_t most = policy.max_spp;
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
