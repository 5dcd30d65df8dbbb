#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace quartet {

/// Samples begin … end − 1 of a pixel.
struct SampleRun {
  std::uint32_t begin;
  std::uint32_t end;
};

/// What somebody takes next: samples taken[p] … taken[p] + wanted[p] − 1 of each pixel p.
struct SampleWish {
  std::span<const std::uint32_t> taken;
  std::span<const std::uint16_t> wanted;
};

/// What several want of one pixel, together. Kept for its memory from one pixel to the next.
class WishedRuns {
 public:
  /// In rising order, with gaps between them; good until the next call.
  std::span<const SampleRun> of(std::span<const SampleWish> wishes, std::size_t pixel);

 private:
  std::vector<SampleRun> runs_;
};

}  // namespace quartet
