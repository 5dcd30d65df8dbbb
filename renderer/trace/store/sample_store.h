#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <mutex>
#include <span>
#include <stop_token>
#include <vector>

#include "renderer/trace/store/plane_pool.h"
#include "renderer/trace/store/running_mean.h"
#include "renderer/trace/store/sample_costs.h"
#include "renderer/trace/store/sample_source.h"
#include "renderer/trace/store/sample_wish.h"
#include "renderer/trace/store/store_pass.h"

namespace quartet {

/// The samples of every pixel, each traced once and then read by all lanes and all replays.
///
/// A sample can always be made again, so that the store is a cache: over its memory budget it
/// forgets what every lane has already used, and from then on a replay traces again.
///
/// The mean of a pixel's first n samples is the same for every lane and every replay. So the store
/// can keep it beside sample n: a replay that wants nothing but means looks one value up where it
/// would add many.
class SampleStore {
 public:
  /// `memory_budget` in bytes. With `keep_means`, memory a sample doubles.
  SampleStore(int width, int height, std::size_t memory_budget, bool keep_means = false);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Another budget, which is looked at when something is to be forgotten.
  void set_memory_budget(std::size_t bytes) { memory_budget_ = bytes; }
  std::size_t memory_budget() const { return memory_budget_; }

  /// Whether samples taken[p] … taken[p] + wanted[p] − 1 of each pixel p are available.
  bool holds(std::span<const std::uint32_t> taken, std::span<const std::uint16_t> wanted) const;

  /// Past the last sample of each pixel that is available.
  std::span<const std::uint32_t> ends() const { return ends_; }

  /// Makes what is wished for available until the next call. Traces what is missing, and nothing
  /// between, on the threads of the current TBB arena. Returns false if `stop` ended it early; what
  /// was traced until then and is to be kept, is.
  bool require(std::span<const SampleWish> wishes, const SampleSource& source,
               std::stop_token stop = {});
  /// Samples that it would trace for that.
  std::uint64_t missing(std::span<const SampleWish> wishes) const;

  /// Copies samples begin, begin + 1, … of a pixel, which must be available, into `out`.
  void read(std::size_t pixel, std::uint32_t begin, std::span<glm::vec3> out) const {
    const auto count = std::uint32_t(out.size());
    if (pass_.has_loose() && !keeps(pixel, begin, count)) {
      for (std::uint32_t i = 0; i < count; ++i) {
        out[i] = sample(pixel, begin + i).radiance;
      }
      return;
    }
    const Place place = places_[pixel];
    const Tile& tile = tiles_[place.tile];
    for (std::uint32_t i = 0; i < count; ++i) {
      out[i] = tile.samples[begin + i - tile.base]->radiance[place.offset];
    }
  }

  /// Fetches `count` samples of a pixel from `begin` on, which must be available, into the cache.
  void prefetch(std::size_t pixel, std::uint32_t begin, std::uint32_t count) const {
    if (pass_.has_loose() && !keeps(pixel, begin, count)) {
      return;
    }
    const Place place = places_[pixel];
    const Tile& tile = tiles_[place.tile];
    for (std::uint32_t i = 0; i < count; ++i) {
      __builtin_prefetch(tile.samples[begin + i - tile.base]->radiance + place.offset);
    }
  }

  /// Every pixel once, tile by tile: the order in which samples lie in memory.
  std::span<const std::uint32_t> pixels() const { return pixels_; }

  /// Whether the mean of the first n samples of a pixel can be looked up for each stored n.
  bool has_means() const { return has_means_; }

  static constexpr int tile_size = int(plane_side);

  /// The means of one tile.
  struct TileMeans {
    int left, top, columns, rows;  // pixels of the picture
    const MeanPlane* const* planes;
    /// Whether any sample of the tile was rejected, so that a mean may be of fewer than n.
    bool rejected;

    /// Of n samples: element tile_size · row + column is that of a pixel. Of a pixel without
    /// samples, black.
    const FirstSamples* of(std::uint32_t n) const { return planes[n]->pixels; }
  };
  int tile_columns() const { return (width_ + tile_size - 1) / tile_size; }
  int tile_rows() const { return (height_ + tile_size - 1) / tile_size; }
  TileMeans tile_means(int column, int row) const {
    const Tile& tile = tiles_[std::size_t(row) * std::size_t(tile_columns()) + std::size_t(column)];
    const int left = column * tile_size;
    const int top = row * tile_size;
    return {left,
            top,
            std::min(tile_size, width_ - left),
            std::min(tile_size, height_ - top),
            tile.means.data(),
            tile.rejected};
  }

  /// Gives the memory of the means back, for good.
  void forget_means();
  /// Gives back what was traced for the last require() alone.
  void forget_loose() { pass_.forget_loose(); }

  /// If the store with `coming` bytes more is over its budget, forgets means, and samples that
  /// nobody takes soon: those below needed[p] of each pixel p, the lowest that somebody takes next
  /// (UINT32_MAX: nobody takes any), and if that is not enough those of the highest numbers, which
  /// are taken last. Where nobody needs any sample, a replay needs the lowest first.
  void trim(std::span<const std::uint32_t> needed, std::size_t coming = 0);

  /// Work of the last wanted[p] of the first taken[p] samples of the pixels of a tile, which must
  /// be available, in the units of SampleCosts.
  std::uint64_t tile_work(int column, int row, std::span<const std::uint32_t> taken,
                          std::span<const std::uint16_t> wanted) const;
  /// What all samples took that were ever traced.
  const SampleCosts& costs() const { return costs_; }

  std::uint64_t traced() const { return traced_; }  ///< samples, since construction
  std::uint64_t stored() const { return stored_; }  ///< samples, now
  std::size_t bytes() const;                        ///< memory in use
  double seconds() const { return seconds_; }       ///< wall-clock time spent tracing
  /// Whether samples were ever forgotten, so that a replay must trace them again.
  bool partial() const { return partial_; }

 private:
  /// One tile: samples[i] holds number base + i of each of its pixels, or is null where none of
  /// them has that sample, and means[n] the means of the first n. Neighbours want the same numbers
  /// at the same time, so that a replay reads memory in order.
  struct Tile {
    std::uint32_t base = 0;  // 0 while there are means
    bool rejected = false;
    std::vector<SamplePlane*> samples;
    std::vector<MeanPlane*> means;
  };

  struct Place {
    std::uint32_t tile;
    std::uint32_t offset;  // in a plane
  };

  /// The mean of samples 0 … end − 1 of a pixel.
  struct Prefix {
    glm::dvec3 sum{0.0};
    std::uint32_t count = 0;  // without the rejected ones
    std::uint32_t rays = 0;
    std::uint32_t end = 0;
  };

  using Job = StorePass::Job;

  std::span<const std::uint32_t> pixels_of(std::size_t tile) const {
    return std::span(pixels_).subspan(first_pixels_[tile],
                                      first_pixels_[tile + 1] - first_pixels_[tile]);
  }
  void make_planes(Tile& tile, std::uint32_t begin, std::uint32_t end, std::mutex& pools);
  void keep_planes(Tile& tile, std::uint32_t begin, std::uint32_t end);
  /// Whether it keeps `count` samples of a pixel from `begin` on.
  bool keeps(std::size_t pixel, std::uint32_t begin, std::uint32_t count) const {
    return begin >= firsts_[pixel] && begin + count <= ends_[pixel];
  }
  StorePass::Sample sample(std::size_t pixel, std::uint32_t index) const;
  template <class Missing>
  void find_missing(std::size_t pixel, std::span<const SampleRun> wanted,
                    const Missing& missing) const;
  void plan_pass(std::span<const SampleWish> wishes);
  void trace_batch(std::span<Job> jobs, const SampleSource& source);
  void keep(const Job& job, const SampleJob& made);
  void append_means(const SampleJob& made, std::uint32_t pixel);
  SampleRun first_of_tile(std::size_t tile, std::uint32_t count) const;
  std::size_t bytes_of_first(std::uint32_t count) const;
  void keep_first(std::uint32_t count);
  void finish_pass(double wall);
  std::size_t cell_of(std::uint32_t tile) const;

  int width_;
  int height_;
  std::size_t memory_budget_;
  std::vector<std::uint32_t> pixels_;
  std::vector<std::size_t> first_pixels_{0};  // of each tile, in pixels_; and where all end
  std::vector<Place> places_;
  // Samples [first, end) of a pixel are here.
  std::vector<std::uint32_t> firsts_;
  std::vector<std::uint32_t> ends_;
  std::vector<Tile> tiles_;
  PlanePool<SamplePlane> sample_planes_;
  PlanePool<MeanPlane> mean_planes_;
  std::vector<Prefix> prefixes_;
  StorePass pass_;  // the one under way, or the last; kept for its memory
  SampleCosts costs_;
  std::uint64_t traced_ = 0;
  std::uint64_t stored_ = 0;
  double seconds_ = 0.0;
  bool has_means_;
  bool partial_ = false;
};

}  // namespace quartet
