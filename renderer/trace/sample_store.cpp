#include "renderer/trace/sample_store.h"

#include <sys/mman.h>
#include <x86intrin.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <new>
#include <numeric>
#include <utility>

#include "renderer/parallel.h"

namespace quartet {
namespace {

// Below this many paths a task costs more to hand out than it gains.
constexpr std::size_t grain_pixels = 64;

}  // namespace

glm::vec3* SampleStore::Planes::allocate() {
  if (!free_.empty()) {
    glm::vec3* plane = free_.back();
    free_.pop_back();
    return plane;
  }
  if (used_ == slab_planes) {
    void* memory = std::aligned_alloc(slab_bytes, slab_bytes);
    if (!memory) {
      throw std::bad_alloc();
    }
    madvise(memory, slab_bytes, MADV_HUGEPAGE);  // a wish; without it all works, slower
    slabs_.emplace_back(static_cast<glm::vec3*>(memory));
    used_ = 0;
  }
  return slabs_.back().get() + plane_samples * used_++;
}

SampleStore::SampleStore(int width, int height, std::size_t memory_budget)
    : width_(width),
      height_(height),
      memory_budget_(memory_budget),
      places_(std::size_t(width) * std::size_t(height)),
      ranges_(places_.size()),
      seconds_per_sample_(places_.size(), 0.0f),
      timed_(places_.size(), 0) {
  const auto columns = std::uint32_t(width);
  const auto rows = std::uint32_t(height);
  for (std::uint32_t top = 0; top < rows; top += tile_size) {
    for (std::uint32_t left = 0; left < columns; left += tile_size) {
      for (std::uint32_t y = top; y < std::min(top + tile_size, rows); ++y) {
        for (std::uint32_t x = left; x < std::min(left + tile_size, columns); ++x) {
          const std::uint32_t pixel = y * columns + x;
          places_[pixel] = {std::uint32_t(tiles_.size()), (y - top) * tile_size + (x - left)};
          pixels_.push_back(pixel);
        }
      }
      tiles_.emplace_back();
    }
  }
}

/// Gives the tile planes for samples [begin, end).
void SampleStore::make_planes(Tile& tile, std::uint32_t begin, std::uint32_t end) {
  if (tile.planes.empty()) {
    tile.base = begin;
  }
  if (begin < tile.base) {
    tile.planes.insert(tile.planes.begin(), tile.base - begin, nullptr);
    tile.base = begin;
  }
  if (end - tile.base > tile.planes.size()) {
    tile.planes.resize(end - tile.base, nullptr);
  }
  for (std::uint32_t i = begin; i < end; ++i) {
    glm::vec3*& plane = tile.planes[i - tile.base];
    if (!plane) {
      plane = planes_.allocate();
    }
  }
}

void SampleStore::release_planes_below(Tile& tile, std::uint32_t index) {
  const std::size_t count =
      index > tile.base ? std::min<std::size_t>(index - tile.base, tile.planes.size()) : 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (tile.planes[i]) {
      planes_.release(tile.planes[i]);
    }
  }
  tile.planes.erase(tile.planes.begin(), tile.planes.begin() + std::ptrdiff_t(count));
  tile.base += std::uint32_t(count);
}

void SampleStore::clear(std::size_t pixel) {
  stored_ -= ranges_[pixel].end - ranges_[pixel].first;
  ranges_[pixel] = {};
}

std::vector<SampleStore::Job> SampleStore::plan_pass(std::span<const std::uint32_t> begin,
                                                     std::span<const std::uint32_t> end) {
  std::vector<Job> jobs;
  for (const std::uint32_t pixel : pixels_) {
    if (begin[pixel] >= end[pixel]) {
      continue;
    }
    Range& range = ranges_[pixel];
    if (begin[pixel] < range.first || begin[pixel] > range.end) {
      clear(pixel);
      range = {begin[pixel], begin[pixel]};
    }
    if (end[pixel] > range.end) {
      make_planes(tiles_[places_[pixel].tile], range.end, end[pixel]);
      jobs.push_back({pixel, end[pixel] - range.end});
    }
  }
  return jobs;
}

bool SampleStore::require(std::span<const std::uint32_t> begin, std::span<const std::uint32_t> end,
                          const SampleSource& source, std::stop_token stop) {
  assert(begin.size() == ranges_.size() && end.size() == ranges_.size());
  const std::vector<Job> jobs = plan_pass(begin, end);
  if (jobs.empty()) {
    return true;
  }
  std::vector<std::uint64_t> ticks(jobs.size(), 0);
  const auto start = std::chrono::steady_clock::now();
  parallel_for(jobs.size(), grain_pixels, [&](std::size_t first, std::size_t last) {
    std::vector<glm::vec3> radiance;
    std::uint64_t before = __rdtsc();
    for (std::size_t i = first; i != last && !stop.stop_requested(); ++i) {
      const auto [pixel, count] = jobs[i];
      const Place place = places_[pixel];
      const Tile& tile = tiles_[place.tile];
      const std::uint32_t index = ranges_[pixel].end;
      radiance.resize(count);
      source(int(pixel) % width_, int(pixel) / width_, index, radiance);
      for (std::uint32_t k = 0; k < count; ++k) {
        tile.planes[index + k - tile.base][place.offset] = radiance[k];
      }
      const std::uint64_t after = __rdtsc();
      ticks[i] = after - before;
      before = after;
    }
  });
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  finish_pass(jobs, ticks, wall);
  return !stop.stop_requested();
}

/// Counts what was traced and shares the pass's wall-clock time among its pixels by the ticks that
/// each took, so that the shares add up to what a user waits.
void SampleStore::finish_pass(std::span<const Job> jobs, std::span<const std::uint64_t> ticks,
                              double wall) {
  const std::uint64_t total = std::accumulate(ticks.begin(), ticks.end(), std::uint64_t(0));
  const double seconds_per_tick = wall / double(std::max<std::uint64_t>(total, 1));
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (ticks[i] == 0) {
      continue;  // the pass was stopped before this pixel
    }
    const auto [pixel, count] = jobs[i];
    ranges_[pixel].end += count;
    stored_ += count;
    traced_ += count;
    timed_[pixel] += count;
    const double seconds = double(ticks[i]) * seconds_per_tick;
    seconds_per_sample_[pixel] +=
        float((seconds - double(count) * double(seconds_per_sample_[pixel])) / timed_[pixel]);
  }
  seconds_ += wall;
}

void SampleStore::trim(std::span<const std::uint32_t> used) {
  assert(used.size() == ranges_.size());
  if (bytes() <= memory_budget_) {
    return;
  }
  partial_ = true;
  std::vector<std::uint32_t> needed(tiles_.size(), UINT32_MAX);
  for (std::size_t pixel = 0; pixel < ranges_.size(); ++pixel) {
    Range& range = ranges_[pixel];
    const std::uint32_t first = std::clamp(used[pixel], range.first, range.end);
    stored_ -= first - range.first;
    range.first = first;
    needed[places_[pixel].tile] = std::min(needed[places_[pixel].tile], first);
  }
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    release_planes_below(tiles_[tile], needed[tile]);
  }
  // Lanes so far apart that what lies between them fills the budget: trace it again when wanted.
  if (bytes() > memory_budget_) {
    for (std::size_t pixel = 0; pixel < ranges_.size(); ++pixel) {
      clear(pixel);
    }
    for (Tile& tile : tiles_) {
      tile = {};
    }
    planes_ = {};
  }
}

std::size_t SampleStore::bytes() const {
  std::size_t pointers = 0;
  for (const Tile& tile : tiles_) {
    pointers += tile.planes.capacity() * sizeof(glm::vec3*);
  }
  constexpr std::size_t per_pixel =
      sizeof(Place) + sizeof(Range) + sizeof(float) + 2 * sizeof(std::uint32_t);
  return planes_.bytes() + pointers + tiles_.size() * sizeof(Tile) + ranges_.size() * per_pixel;
}

}  // namespace quartet
