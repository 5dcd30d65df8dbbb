#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace quartet {

/// What a store traces at once. Most samples are put away as they come; those that the store does
/// not keep are loose, and can be read until the next pass.
class StorePass {
 public:
  /// Samples first, first + 1, … of a pixel that are to be traced, and how it went.
  struct Job {
    std::uint32_t pixel;
    std::uint32_t first;
    std::uint32_t count;
    bool is_loose = false;
    bool traced = false;
    bool rejected = false;   // any of them
    std::uint64_t work = 0;  // in the units of SampleCosts
    double ticks = 0.0;
    std::size_t loose_at = 0;  // of a loose one's first sample
  };

  /// No jobs, of so many tiles.
  void clear(std::size_t tiles);
  /// How many jobs each tile has was counted in counts(): makes room for them.
  void make_jobs();
  /// Where the jobs of a tile begin among all; where they all end is that of the tile past the
  /// last.
  std::size_t first_job(std::size_t tile) const { return first_jobs_[tile]; }
  std::uint64_t& count(std::size_t tile) { return first_jobs_[tile + 1]; }
  std::span<Job> jobs() { return jobs_; }
  std::span<const Job> jobs() const { return jobs_; }
  /// Makes room for the samples of loose jobs, once all jobs are written.
  void make_loose();

  bool has_loose() const { return !radiance_.empty(); }
  std::span<glm::vec3> radiance(const Job& job) { return part_of(radiance_, job); }
  std::span<std::uint16_t> rays(const Job& job) { return part_of(rays_, job); }

  struct Sample {
    glm::vec3 radiance;
    std::uint16_t rays;
  };
  /// A loose sample of a pixel of a tile, which must be there. Jobs of a tile stand in rising order
  /// of pixel and index.
  Sample loose(std::size_t tile, std::uint32_t pixel, std::uint32_t index) const;
  void forget_loose();

  std::size_t bytes() const;  ///< memory in use

 private:
  template <class T>
  static std::span<T> part_of(std::vector<T>& all, const Job& job) {
    return std::span(all).subspan(job.loose_at, job.count);
  }

  std::vector<std::uint64_t> first_jobs_;
  std::vector<Job> jobs_;
  std::vector<glm::vec3> radiance_;
  std::vector<std::uint16_t> rays_;
};

}  // namespace quartet
