#pragma once

#include <array>
#include <cstdint>
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

  /// Samples [begin, end) of a pixel, which must be available.
  std::span<const glm::vec3> samples(std::size_t pixel, std::uint32_t begin,
                                     std::uint32_t end) const {
    const Record& record = records_[pixel];
    return {record.data + (begin - record.first), end - begin};
  }

  /// Fetches sample `begin` of a pixel into the cache, if it is there.
  void prefetch(std::size_t pixel, std::uint32_t begin) const {
    const Record& record = records_[pixel];
    __builtin_prefetch(record.data + (begin - record.first));
  }

  /// Forgets samples below used[p] of each pixel if the store is over its budget.
  void trim(std::span<const std::uint32_t> used);

  /// Mean wall-clock seconds that one sample of each pixel took, with the threads that traced it
  /// all at work. What a lane's samples cost is the sum of counts times this.
  std::span<const float> seconds_per_sample() const { return seconds_per_sample_; }

  std::uint64_t traced() const { return traced_; }  ///< samples, since construction
  std::uint64_t stored() const { return stored_; }  ///< samples, now
  std::size_t bytes() const;                        ///< memory held
  double seconds() const { return seconds_; }       ///< wall-clock time spent tracing
  /// Whether samples were ever forgotten, so that a replay must trace them again.
  bool partial() const { return partial_; }

 private:
  /// A run of samples of one pixel in one block.
  struct Record {
    glm::vec3* data = nullptr;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    int size_class = 0;  // of the block, where there is one
  };

  /// Blocks of 2^k samples. Small ones come from slabs and go back to a list of their size.
  class Blocks {
   public:
    glm::vec3* allocate(int size_class);
    void release(glm::vec3* block, int size_class);
    std::size_t bytes() const { return bytes_; }

   private:
    static constexpr int largest_small = 12;
    static constexpr std::size_t slab_samples = std::size_t(1) << 17;

    std::vector<std::unique_ptr<glm::vec3[]>> slabs_;
    std::size_t slab_used_ = slab_samples;
    std::array<std::vector<glm::vec3*>, largest_small + 1> free_;
    std::vector<std::unique_ptr<glm::vec3[]>> large_;
    std::size_t bytes_ = 0;
  };

  struct Job {
    std::uint32_t pixel;
    std::uint32_t count;  // samples to append
  };

  static int size_class(std::uint32_t count);
  void reserve(Record& record, std::uint32_t count);
  void clear(Record& record);
  std::vector<Job> plan_pass(std::span<const std::uint32_t> begin,
                             std::span<const std::uint32_t> end);
  void finish_pass(std::span<const Job> jobs, std::span<const std::uint64_t> ticks, double wall);

  int width_;
  int height_;
  std::size_t memory_budget_;
  std::vector<Record> records_;
  std::unique_ptr<Blocks> blocks_;
  std::vector<float> seconds_per_sample_;
  std::vector<std::uint32_t> timed_;       // samples behind each mean
  std::vector<std::uint32_t> tile_order_;  // pixels, tile by tile
  std::uint64_t traced_ = 0;
  std::uint64_t stored_ = 0;
  double seconds_ = 0.0;
  bool partial_ = false;
};

}  // namespace quartet
