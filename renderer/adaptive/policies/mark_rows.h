#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/adaptive/pixel_state.h"
#include "renderer/adaptive/policies/policy.h"

namespace quartet {

/// The pixels of the last three rows that are not done, as PlanRow has them.
class MarkRows {
 public:
  MarkRows(std::size_t width, int height)
      : width_(width), height_(height), marks_(4 * (width + 2)) {}

  bool in_picture(int y) const { return y >= 0 && y < height_; }

  /// To be marked; the two rows marked before are still there.
  std::span<std::uint8_t> row(int y) { return {marks(y), width_}; }

  /// Pixels of a row that are not done.
  std::uint32_t count(int y) const {
    const std::uint8_t* const values = marks(y);
    std::uint32_t sum = 0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t x = 0; x < width_; ++x) {
      sum += values[x];
    }
    return sum;
  }

  /// A row whose neighbours are marked too.
  PlanRow plan_row(int y, std::uint32_t pass, std::span<const std::uint32_t> taken) const {
    return {
        pass, std::uint32_t(std::size_t(y) * width_), width_, marks(y - 1), marks(y), marks(y + 1),
        taken};
  }

 private:
  // Three rows, and one of zeros for those outside the picture.
  std::size_t place(int y) const {
    return (in_picture(y) ? std::size_t(y % 3) : 3) * (width_ + 2) + 1;
  }
  std::uint8_t* marks(int y) {
    return marks_.data() + place(y);
  }
  const std::uint8_t* marks(int y) const {
    return marks_.data() + place(y);
  }

  std::size_t width_;
  int height_;
  std::vector<std::uint8_t> marks_;
};

}  // namespace quartet
