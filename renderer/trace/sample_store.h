#pragma once

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

namespace quartet {

/// Writes samples first, first + 1, … of pixel (x, y) as linear radiance: the tracer, or anything
/// else that is a pure function of its arguments. Called from many threads.
using SampleSource =
    std::function<void(int x, int y, std::uint32_t first, std::span<glm::vec3> radiance)>;

/// The samples of every pixel, each traced once and then read by all lanes and all replays.
///
/// A sample can always be made again, so that the store is a cache: over its memory budget it
/// forgets what every lane has already used, and from then on a replay traces again.
class SampleStore {
 public:
  /// `memory_budget` in bytes.
  SampleStore(int width, int height, std::size_t memory_budget);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Makes samples [begin[p], end[p]) of each pixel p available; nothing where begin ≥ end. Traces
  /// what is missing on the threads of the current TBB arena. Returns false if `stop` ended it
  /// early; what was traced until then is kept.
  bool require(std::span<const std::uint32_t> begin, std::span<const std::uint32_t> end,
               const SampleSource& source, std::stop_token stop = {});

  /// Copies samples begin, begin + 1, … of a pixel, which must be available, into `out`.
  void read(std::size_t pixel, std::uint32_t begin, std::span<glm::vec3> out) const {
    const Place place = places_[pixel];
    const Tile& tile = tiles_[place.tile];
    for (std::uint32_t i = 0; i < out.size(); ++i) {
      out[i] = tile.planes[begin + i - tile.base][place.offset];
    }
  }

  /// Fetches `count` samples of a pixel from `begin` on, which must be available, into the cache.
  void prefetch(std::size_t pixel, std::uint32_t begin, std::uint32_t count) const {
    const Place place = places_[pixel];
    const Tile& tile = tiles_[place.tile];
    for (std::uint32_t i = 0; i < count; ++i) {
      __builtin_prefetch(tile.planes[begin + i - tile.base] + place.offset);
    }
  }

  /// Every pixel once, tile by tile: the order in which samples lie in memory.
  std::span<const std::uint32_t> pixels() const { return pixels_; }

  /// Forgets samples below used[p] of each pixel if the store is over its budget.
  void trim(std::span<const std::uint32_t> used);

  /// Mean wall-clock seconds that one sample of each pixel took, with the threads that traced it
  /// all at work. What a lane's samples cost is the sum of counts times this.
  std::span<const float> seconds_per_sample() const { return seconds_per_sample_; }

  std::uint64_t traced() const { return traced_; }  ///< samples, since construction
  std::uint64_t stored() const { return stored_; }  ///< samples, now
  std::size_t bytes() const;                        ///< memory in use
  double seconds() const { return seconds_; }       ///< wall-clock time spent tracing
  /// Whether samples were ever forgotten, so that a replay must trace them again.
  bool partial() const { return partial_; }

 private:
  static constexpr std::uint32_t tile_size = 8;
  static constexpr std::size_t plane_samples = std::size_t(tile_size) * tile_size;

  /// Samples of one tile: planes[i] holds number base + i of each of its pixels, or is null where
  /// none of them has that sample. Neighbours want the same numbers at the same time, so that a
  /// replay reads memory in order.
  struct Tile {
    std::uint32_t base = 0;
    std::vector<glm::vec3*> planes;
  };

  struct Place {
    std::uint32_t tile;
    std::uint32_t offset;  // in a plane
  };

  /// Samples [first, end) of a pixel are here.
  struct Range {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
  };

  /// Planes, cut from slabs.
  class Planes {
   public:
    glm::vec3* allocate();
    void release(glm::vec3* plane) { free_.push_back(plane); }
    /// Of the planes in use; what has been released waits to be used again.
    std::size_t bytes() const {
      const std::size_t cut = slabs_.size() * slab_planes - (slab_planes - used_);
      return slabs_.empty() ? 0 : (cut - free_.size()) * plane_samples * sizeof(glm::vec3);
    }

   private:
    struct Free {
      void operator()(glm::vec3* slab) const { std::free(slab); }
    };
    // Huge pages: a replay touches every plane, and would else wait for the page tables.
    static constexpr std::size_t slab_bytes = std::size_t(2) << 20;
    static constexpr std::size_t slab_planes = slab_bytes / (plane_samples * sizeof(glm::vec3));

    std::vector<std::unique_ptr<glm::vec3[], Free>> slabs_;
    std::size_t used_ = slab_planes;  // of the last slab
    std::vector<glm::vec3*> free_;
  };

  struct Job {
    std::uint32_t pixel;
    std::uint32_t count;  // samples to append
  };

  void make_planes(Tile& tile, std::uint32_t begin, std::uint32_t end);
  void release_planes_below(Tile& tile, std::uint32_t index);
  void clear(std::size_t pixel);
  std::vector<Job> plan_pass(std::span<const std::uint32_t> begin,
                             std::span<const std::uint32_t> end);
  void finish_pass(std::span<const Job> jobs, std::span<const std::uint64_t> ticks, double wall);

  int width_;
  int height_;
  std::size_t memory_budget_;
  std::vector<std::uint32_t> pixels_;
  std::vector<Place> places_;
  std::vector<Range> ranges_;
  std::vector<Tile> tiles_;
  Planes planes_;
  std::vector<float> seconds_per_sample_;
  std::vector<std::uint32_t> timed_;  // samples behind each mean
  std::uint64_t traced_ = 0;
  std::uint64_t stored_ = 0;
  double seconds_ = 0.0;
  bool partial_ = false;
};

}  // namespace quartet
