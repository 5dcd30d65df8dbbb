#include "renderer/trace/sample_store.h"

#include <x86intrin.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <chrono>
#include <numeric>
#include <utility>

#include "renderer/parallel.h"

namespace quartet {
namespace {

// Neighbouring pixels meet the same part of the hierarchy.
constexpr int tile_size = 16;
// Below this many paths a task costs more to hand out than it gains.
constexpr std::size_t grain_pixels = 64;
constexpr int smallest_class = 2;

std::vector<std::uint32_t> pixels_by_tile(int width, int height) {
  std::vector<std::uint32_t> order;
  order.reserve(std::size_t(width) * std::size_t(height));
  for (int ty = 0; ty < height; ty += tile_size) {
    for (int tx = 0; tx < width; tx += tile_size) {
      for (int y = ty; y < std::min(ty + tile_size, height); ++y) {
        for (int x = tx; x < std::min(tx + tile_size, width); ++x) {
          order.push_back(std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x));
        }
      }
    }
  }
  return order;
}

}  // namespace

glm::vec3* SampleStore::Blocks::allocate(int size_class) {
  const std::size_t samples = std::size_t(1) << size_class;
  if (size_class > largest_small) {
    large_.push_back(std::make_unique_for_overwrite<glm::vec3[]>(samples));
    bytes_ += samples * sizeof(glm::vec3);
    return large_.back().get();
  }
  auto& free = free_[std::size_t(size_class)];
  if (!free.empty()) {
    glm::vec3* block = free.back();
    free.pop_back();
    return block;
  }
  if (slab_used_ + samples > slab_samples) {
    slabs_.push_back(std::make_unique_for_overwrite<glm::vec3[]>(slab_samples));
    bytes_ += slab_samples * sizeof(glm::vec3);
    slab_used_ = 0;
  }
  glm::vec3* block = slabs_.back().get() + slab_used_;
  slab_used_ += samples;
  return block;
}

void SampleStore::Blocks::release(glm::vec3* block, int size_class) {
  if (size_class <= largest_small) {
    free_[std::size_t(size_class)].push_back(block);
    return;
  }
  const auto found = std::find_if(large_.begin(), large_.end(),
                                  [&](const auto& owner) { return owner.get() == block; });
  assert(found != large_.end());
  large_.erase(found);
  bytes_ -= (std::size_t(1) << size_class) * sizeof(glm::vec3);
}

SampleStore::SampleStore(int width, int height, std::size_t memory_budget)
    : width_(width),
      height_(height),
      memory_budget_(memory_budget),
      records_(std::size_t(width) * std::size_t(height)),
      blocks_(std::make_unique<Blocks>()),
      seconds_per_sample_(records_.size(), 0.0f),
      timed_(records_.size(), 0),
      tile_order_(pixels_by_tile(width, height)) {
}

int SampleStore::size_class(std::uint32_t count) {
  return std::max(smallest_class, int(std::bit_width(count - 1)));
}

/// Gives the record room for `count` samples, keeping those it has.
void SampleStore::reserve(Record& record, std::uint32_t count) {
  const int wanted = size_class(count);
  if (record.data && wanted <= record.size_class) {
    return;
  }
  glm::vec3* data = blocks_->allocate(wanted);
  if (record.data) {
    std::copy_n(record.data, record.count, data);
    blocks_->release(record.data, record.size_class);
  }
  record.data = data;
  record.size_class = wanted;
}

void SampleStore::clear(Record& record) {
  if (record.data) {
    blocks_->release(record.data, record.size_class);
  }
  stored_ -= record.count;
  record = {};
}

std::vector<SampleStore::Job> SampleStore::plan_pass(std::span<const std::uint32_t> begin,
                                                     std::span<const std::uint32_t> end) {
  std::vector<Job> jobs;
  for (const std::uint32_t pixel : tile_order_) {
    if (begin[pixel] >= end[pixel]) {
      continue;
    }
    Record& record = records_[pixel];
    if (begin[pixel] < record.first || begin[pixel] > record.first + record.count) {
      clear(record);
      record.first = begin[pixel];
    }
    const std::uint32_t available = record.first + record.count;
    if (end[pixel] > available) {
      reserve(record, end[pixel] - record.first);
      jobs.push_back({pixel, end[pixel] - available});
    }
  }
  return jobs;
}

bool SampleStore::require(std::span<const std::uint32_t> begin, std::span<const std::uint32_t> end,
                          const SampleSource& source, std::stop_token stop) {
  assert(begin.size() == records_.size() && end.size() == records_.size());
  const std::vector<Job> jobs = plan_pass(begin, end);
  if (jobs.empty()) {
    return true;
  }
  std::vector<std::uint64_t> ticks(jobs.size(), 0);
  const auto start = std::chrono::steady_clock::now();
  parallel_for(jobs.size(), grain_pixels, [&](std::size_t first, std::size_t last) {
    if (stop.stop_requested()) {
      return;
    }
    std::uint64_t before = __rdtsc();
    for (std::size_t i = first; i != last; ++i) {
      const Record& record = records_[jobs[i].pixel];
      const int x = int(jobs[i].pixel % std::uint32_t(width_));
      const int y = int(jobs[i].pixel / std::uint32_t(width_));
      source(x, y, record.first + record.count, {record.data + record.count, jobs[i].count});
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
    records_[pixel].count += count;
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
  assert(used.size() == records_.size());
  if (bytes() <= memory_budget_) {
    return;
  }
  partial_ = true;
  // Into new slabs, because the old ones are full of holes.
  auto old = std::exchange(blocks_, std::make_unique<Blocks>());
  for (std::size_t pixel = 0; pixel < records_.size(); ++pixel) {
    const Record from = std::exchange(records_[pixel], {});
    const std::uint32_t end = from.first + from.count;
    Record& to = records_[pixel];
    to.first = std::clamp(used[pixel], from.first, end);
    stored_ -= to.first - from.first;
    if (to.first < end) {
      reserve(to, end - to.first);
      to.count = end - to.first;
      std::copy_n(from.data + (to.first - from.first), to.count, to.data);
    }
  }
  // Lanes so far apart that what lies between them fills the budget: trace it again when wanted.
  if (bytes() > memory_budget_) {
    for (Record& record : records_) {
      clear(record);
    }
    blocks_ = std::make_unique<Blocks>();
  }
}

std::size_t SampleStore::bytes() const {
  return blocks_->bytes() +
         records_.size() * (sizeof(Record) + sizeof(float) + 2 * sizeof(std::uint32_t));
}

}  // namespace quartet
