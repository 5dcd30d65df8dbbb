#include "renderer/trace/store/sample_wish.h"

#include <algorithm>

namespace quartet {

std::span<const SampleRun> WishedRuns::of(std::span<const SampleWish> wishes, std::size_t pixel) {
  runs_.clear();
  for (const SampleWish& wish : wishes) {
    const std::uint32_t taken = wish.taken[pixel];
    if (const std::uint32_t wanted = wish.wanted[pixel]; wanted > 0) {
      runs_.push_back({taken, taken + wanted});
    }
  }
  if (runs_.size() < 2) {
    return runs_;
  }
  std::ranges::sort(runs_, {}, &SampleRun::begin);
  std::size_t last = 0;
  for (std::size_t i = 1; i < runs_.size(); ++i) {
    if (runs_[i].begin <= runs_[last].end) {
      runs_[last].end = std::max(runs_[last].end, runs_[i].end);
    } else {
      runs_[++last] = runs_[i];
    }
  }
  runs_.resize(last + 1);
  return runs_;
}

}  // namespace quartet
