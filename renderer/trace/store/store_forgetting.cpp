#include <algorithm>
#include <atomic>
#include <cassert>

#include "renderer/base/parallel.h"
#include "renderer/trace/store/sample_store.h"

// What a store does without, where memory is short.

namespace quartet {
namespace {

// Tiles handed to one thread at a time.
constexpr std::size_t forgetting_grain = 512;

}  // namespace

void SampleStore::forget_means() {
  has_means_ = false;
  for (Tile& tile : tiles_) {
    tile.means = std::vector<MeanPlane*>();
  }
  mean_planes_ = {};
  prefixes_ = std::vector<Prefix>();
}

void SampleStore::trim(std::span<const std::uint32_t> needed, std::size_t coming) {
  assert(needed.size() == ends_.size());
  forget_loose();
  if (bytes() + coming <= memory_budget_) {
    return;
  }
  forget_means();
  partial_ = true;
  std::uint64_t needed_samples = 0;
  for (std::size_t pixel = 0; pixel < ends_.size(); ++pixel) {
    needed_samples += ends_[pixel] - std::clamp(needed[pixel], firsts_[pixel], ends_[pixel]);
  }
  // What nobody needs is of use to a replay from the start; but what somebody needs goes first.
  if (needed_samples > 0) {
    for (std::size_t pixel = 0; pixel < ends_.size(); ++pixel) {
      const std::uint32_t first = std::clamp(needed[pixel], firsts_[pixel], ends_[pixel]);
      stored_ -= first - firsts_[pixel];
      firsts_[pixel] = first;
    }
    keep_first(UINT32_MAX);
  }
  // If that is still too much, of each pixel the samples that are taken first. They are found by
  // halves.
  std::uint32_t least = 0;
  std::uint32_t most = 0;
  for (std::size_t pixel = 0; pixel < ends_.size(); ++pixel) {
    most = std::max(most, ends_[pixel] - firsts_[pixel]);
  }
  const std::size_t fixed = bytes() - sample_planes_.bytes() + coming;
  const std::size_t room = memory_budget_ > fixed ? memory_budget_ - fixed : 0;
  if (sample_planes_.bytes() <= room) {
    return;
  }
  while (least + 1 < most) {
    const std::uint32_t middle = least + (most - least) / 2;
    (bytes_of_first(middle) <= room ? least : most) = middle;
  }
  keep_first(least);
}

/// The first and past the last sample of a tile's pixels, if each keeps at most so many.
SampleRun SampleStore::first_of_tile(std::size_t tile, std::uint32_t count) const {
  SampleRun kept{UINT32_MAX, 0};
  for (const std::uint32_t pixel : pixels_of(tile)) {
    if (const std::uint32_t have = ends_[pixel] - firsts_[pixel]; std::min(have, count) > 0) {
      kept.begin = std::min(kept.begin, firsts_[pixel]);
      kept.end = std::max(kept.end, firsts_[pixel] + std::min(have, count));
    }
  }
  return kept.end > 0 ? kept : SampleRun{0, 0};
}

/// Memory of the first samples that each pixel has, at most so many.
std::size_t SampleStore::bytes_of_first(std::uint32_t count) const {
  std::atomic<std::size_t> planes = 0;
  parallel_for(tiles_.size(), forgetting_grain, [&](std::size_t first, std::size_t last) {
    std::size_t sum = 0;
    for (std::size_t tile = first; tile < last; ++tile) {
      const SampleRun kept = first_of_tile(tile, count);
      sum += kept.end - kept.begin;
    }
    planes += sum;
  });
  return planes * sizeof(SamplePlane);
}

/// Forgets all but the first samples that each pixel has, at most so many.
void SampleStore::keep_first(std::uint32_t count) {
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    const SampleRun kept = first_of_tile(tile, count);
    keep_planes(tiles_[tile], kept.begin, kept.end);
    for (const std::uint32_t pixel : pixels_of(tile)) {
      const std::uint32_t end = firsts_[pixel] + std::min(ends_[pixel] - firsts_[pixel], count);
      stored_ -= ends_[pixel] - end;
      ends_[pixel] = end;
    }
  }
}

/// Gives back all planes of a tile but those of samples [begin, end).
void SampleStore::keep_planes(Tile& tile, std::uint32_t begin, std::uint32_t end) {
  const auto size = std::uint32_t(tile.samples.size());
  begin = std::clamp(begin, tile.base, tile.base + size) - tile.base;
  end = std::clamp(end, tile.base + begin, tile.base + size) - tile.base;
  for (std::uint32_t i = 0; i < size; ++i) {
    if ((i < begin || i >= end) && tile.samples[i]) {
      sample_planes_.release(tile.samples[i]);
    }
  }
  tile.samples.resize(end);
  tile.samples.erase(tile.samples.begin(), tile.samples.begin() + std::ptrdiff_t(begin));
  tile.base += begin;
}

}  // namespace quartet
