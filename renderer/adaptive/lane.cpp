#include "renderer/adaptive/lane.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "renderer/parallel.h"

namespace quartet {
namespace {

// Pixels handed to one thread at a time; a smaller piece costs more to hand out than it gains.
constexpr std::size_t grain_pixels = 1 << 12;

}  // namespace

Lane::Lane(int width, int height, const SamplingPolicy& policy, FilmStatistics statistics)
    : policy_(policy), film_(width, height, statistics), taken_(film_.size(), 0) {
  replan();
}

void Lane::restart(const SamplingPolicy& policy) {
  policy_ = policy;
  film_.clear();
  error_.clear();
  std::fill(taken_.begin(), taken_.end(), 0u);
  history_.clear();
  own_seconds_ = 0.0;
  replan();
}

void Lane::begin_frame(const SampleStore& store) {
  rows_.assign(std::size_t(store.tile_rows()), {});
  looks_up_ = store.has_means() && !film_.has_sums() && !film_.statistics().variance;
  assert(looks_up_ || film_.has_sums() || frame() == 0);
  if (!looks_up_) {
    film_.keep_sums();
  }
}

void Lane::take(const SampleStore& store, int tile_row) {
  const auto width = std::size_t(film_.width());
  const std::size_t begin = std::size_t(tile_row) * SampleStore::tile_size * width;
  const std::size_t end = std::min(begin + SampleStore::tile_size * width, film_.size());
  if (looks_up_) {
    rows_[std::size_t(tile_row)] = count(store, begin, end);
    look_up(store, tile_row);
  } else {
    accumulate(store, begin, end);
    rows_[std::size_t(tile_row)] = count(store, begin, end);
  }
}

void Lane::end_frame(double take_seconds) {
  const auto start = std::chrono::steady_clock::now();
  const Estimator& row = estimator(policy_.estimator);
  if (row.estimate) {
    error_.resize(std::size_t(row.channels) * film_.size());
    row.estimate(film_, error_);
  }
  FrameRecord record;
  record.frame = frame() + 1;
  record.samples = (history_.empty() ? 0 : history_.back().samples) + plan_.total;
  for (const RowTotal& total : rows_) {
    record.max_spp = std::max(record.max_spp, total.max_spp);
    record.seconds += total.seconds;
  }
  history_.push_back(record);
  replan();
  own_seconds_ += take_seconds +
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  history_.back().refined = plan_.refined;
  history_.back().seconds += own_seconds_;
}

/// Adds what is wanted of pixels [begin, end) to what is taken.
Lane::RowTotal Lane::count(const SampleStore& store, std::size_t begin, std::size_t end) {
  std::uint32_t* taken = taken_.data();
  const std::uint16_t* wanted = plan_.wanted.data();
  const float* cost = store.seconds_per_sample().data();
  std::uint32_t most = 0;
  double seconds = 0.0;
#pragma omp simd reduction(max : most) reduction(+ : seconds)
  for (std::size_t i = begin; i < end; ++i) {
    taken[i] += wanted[i];
    most = std::max(most, taken[i]);
    // Through int, for which there are vectors.
    seconds += double(std::int32_t(taken[i])) * double(cost[i]);
  }
  return {most, seconds};
}

/// Reads the means of all samples taken, one tile after the other as they lie in memory.
void Lane::look_up(const SampleStore& store, int tile_row) {
  // Asked for this many tiles ahead, means have come when they are wanted; else a replay does
  // little but wait for memory.
  constexpr int ahead = 4;
  constexpr int side = SampleStore::tile_size;
  const std::size_t width = std::size_t(film_.width());
  const std::uint32_t* taken = taken_.data();
  for (int column = -ahead; column < store.tile_columns(); ++column) {
    if (column + ahead < store.tile_columns()) {
      const SampleStore::TileMeans tile = store.tile_means(column + ahead, tile_row);
      for (int y = 0; y < tile.rows; ++y) {
        const std::uint32_t* n = taken + std::size_t(tile.top + y) * width + std::size_t(tile.left);
        for (int x = 0; x < tile.columns; ++x) {
          __builtin_prefetch(tile.of(n[x]) + std::ptrdiff_t(y) * side + x);
        }
      }
    }
    if (column < 0) {
      continue;
    }
    const SampleStore::TileMeans tile = store.tile_means(column, tile_row);
    if (tile.rejected) {
      look_up_with_rejected(store, tile);
      continue;
    }
    for (int y = 0; y < tile.rows; ++y) {
      const std::size_t first = std::size_t(tile.top + y) * width + std::size_t(tile.left);
      for (int x = 0; x < tile.columns; ++x) {
        const std::size_t pixel = first + std::size_t(x);
        film_.put(pixel, taken[pixel], tile.of(taken[pixel])[y * side + x]);
      }
    }
  }
}

/// The same where some sample of a tile was rejected: the newly taken ones must be looked at.
void Lane::look_up_with_rejected(const SampleStore& store, const SampleStore::TileMeans& tile) {
  std::vector<glm::vec3> samples;
  for (int y = 0; y < tile.rows; ++y) {
    const std::size_t first =
        std::size_t(tile.top + y) * std::size_t(film_.width()) + std::size_t(tile.left);
    for (int x = 0; x < tile.columns; ++x) {
      const std::size_t pixel = first + std::size_t(x);
      samples.resize(plan_.wanted[pixel]);
      store.read(pixel, taken_[pixel] - plan_.wanted[pixel], samples);
      film_.reject(pixel, samples);
      film_.put(pixel, taken_[pixel] - film_.rejected()[pixel],
                tile.of(taken_[pixel])[y * SampleStore::tile_size + x]);
    }
  }
}

/// Adds the samples of pixels [begin, end), whole rows of tiles, to what is there.
void Lane::accumulate(const SampleStore& store, std::size_t begin, std::size_t end) {
  // As above.
  constexpr std::size_t ahead = 32;
  const std::span<const std::uint32_t> pixels = store.pixels();
  std::vector<glm::vec3> samples;
  for (std::size_t i = begin; i < end; ++i) {
    if (i + ahead < end) {
      const std::uint32_t later = pixels[i + ahead];
      store.prefetch(later, taken_[later], plan_.wanted[later]);
    }
    const std::uint32_t pixel = pixels[i];
    if (plan_.wanted[pixel] > 0) {
      samples.resize(plan_.wanted[pixel]);
      store.read(pixel, taken_[pixel], samples);
      film_.add(pixel, samples);
    }
  }
}

void Lane::catch_up(const SampleStore& store) {
  if (film_.has_sums()) {
    return;
  }
  film_.keep_sums();
  parallel_for(film_.size(), grain_pixels, [&](std::size_t begin, std::size_t end) {
    std::vector<glm::vec3> samples;
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      samples.resize(taken_[pixel]);
      store.read(pixel, 0, samples);
      film_.restore_sum(pixel, samples);
    }
  });
}

void Lane::replan() {
  plan_next(policy_, {film_.width(), film_.height(), error_, taken_, frame()}, plan_);
}

}  // namespace quartet
