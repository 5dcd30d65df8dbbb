#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/pixel_state.h"
#include "renderer/adaptive/policies/policy.h"
#include "renderer/base/parallel.h"

namespace quartet {

// What plans are made of.

/// Rows handed to one thread at a time; a smaller piece costs more to hand out than it gains.
inline constexpr std::size_t plan_grain_rows = 32;

/// Sum of a few thousand values, each at most 255, in vectors.
inline std::uint32_t sum_of_marks(const std::uint8_t* values, std::size_t count) {
  std::uint32_t sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < count; ++i) {
    sum += values[i];
  }
  return sum;
}

/// The pixels of each row that are not done, kept for as long as rows nearby count them.
class PlanMarks {
 public:
  PlanMarks(const LaneSettings& settings, const PlanInput& input)
      : criterion_(settings, input.error, input.taken),
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

  std::uint32_t count(int y) { return sum_of_marks(row(y), width_); }

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

/// Marks and counts the pixels that are not done, and calls row(y, marks, wanted) for each row of
/// the picture, from several threads.
template <class Row>
void plan_rows(const LaneSettings& settings, const PlanInput& input, Plan& plan, const Row& row) {
  const auto width = std::size_t(input.width);
  std::atomic<std::uint64_t> not_done = 0;
  parallel_for(std::size_t(input.height), plan_grain_rows, [&](std::size_t begin, std::size_t end) {
    PlanMarks marks(settings, input);
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

inline void plan_everywhere(Plan& plan, std::uint16_t samples) {
  std::fill(plan.wanted.begin(), plan.wanted.end(), samples);
}

/// What most policies give a pixel at once: one round of the sampler's stratification.
inline constexpr std::uint16_t usual_batch = 8;

/// Of a parameter that is 0 where it is left to the policy.
inline std::uint16_t chosen_samples(std::uint16_t asked, std::uint16_t otherwise) {
  return asked > 0 ? asked : otherwise;
}

/// As many samples for every pixel that is not done, none for the others.
inline void plan_not_done(const LaneSettings& settings, const PlanInput& input, Plan& plan,
                          std::uint16_t samples) {
  const auto width = std::size_t(input.width);
  plan_rows(settings, input, plan, [&](std::size_t y, PlanMarks& marks, std::uint16_t* wanted) {
    const std::uint8_t* row = marks.row(int(y));
#pragma omp simd
    for (std::size_t x = 0; x < width; ++x) {
      wanted[x] = std::uint16_t(row[x] * samples);
    }
  });
}

}  // namespace quartet
