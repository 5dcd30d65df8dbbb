#pragma once

#include <cstdint>
#include <span>

#include "renderer/adaptive/lane.h"

namespace quartet {

/// Samples of a run that no film takes (NaN, infinite or negative), and where the first of them is.
struct RejectedCount {
  std::uint64_t count = 0;
  std::uint64_t seed = 0;   ///< of the run
  std::size_t pixel = 0;    ///< the first that has one
  std::uint32_t taken = 0;  ///< samples of that pixel, among which it is
};

/// `rejected` and `taken` are samples of each pixel; the first may be empty if there are none.
RejectedCount rejected_of(std::span<const std::uint32_t> rejected,
                          std::span<const std::uint32_t> taken, std::uint64_t seed);
/// Of what a lane shows.
RejectedCount rejected_of(const Lane& lane, std::uint64_t seed);

/// Runs share samples, so that counts are not added up: of several runs the one with most is told.
void keep_most(RejectedCount& most, const RejectedCount& other);

}  // namespace quartet
