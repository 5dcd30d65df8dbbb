#include "renderer/measure/rejected_count.h"

#include <algorithm>
#include <numeric>

namespace quartet {

RejectedCount rejected_of(std::span<const std::uint32_t> rejected,
                          std::span<const std::uint32_t> taken, std::uint64_t seed) {
  RejectedCount result{.seed = seed};
  result.count = std::accumulate(rejected.begin(), rejected.end(), std::uint64_t(0));
  if (result.count > 0) {
    const auto first = std::ranges::find_if(rejected, [](std::uint32_t n) { return n > 0; });
    result.pixel = std::size_t(first - rejected.begin());
    result.taken = taken[result.pixel];
  }
  return result;
}

RejectedCount rejected_of(const Lane& lane, std::uint64_t seed) {
  return rejected_of(lane.film().rejected(), lane.taken(), seed);
}

void keep_most(RejectedCount& most, const RejectedCount& other) {
  if (other.count > most.count) {
    most = other;
  }
}

}  // namespace quartet
