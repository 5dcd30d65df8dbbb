#include "renderer/trace/store/store_pass.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace quartet {

void StorePass::clear(std::size_t tiles) {
  first_jobs_.assign(tiles + 1, 0);
  jobs_.clear();
  forget_loose();
}

void StorePass::make_jobs() {
  std::partial_sum(first_jobs_.begin(), first_jobs_.end(), first_jobs_.begin());
  jobs_.resize(first_jobs_.back());
}

void StorePass::make_loose() {
  std::size_t samples = 0;
  for (Job& job : jobs_) {
    if (job.is_loose) {
      job.loose_at = samples;
      samples += job.count;
    }
  }
  radiance_.resize(samples);
  rays_.resize(samples);
}

StorePass::Sample StorePass::loose(std::size_t tile, std::uint32_t pixel,
                                   std::uint32_t index) const {
  const std::span<const Job> jobs =
      std::span(jobs_).subspan(first_jobs_[tile], first_jobs_[tile + 1] - first_jobs_[tile]);
  // The last one that begins at or before the sample.
  const auto place = [](const Job& job) { return std::pair(job.pixel, job.first); };
  const auto after = std::ranges::upper_bound(jobs, std::pair(pixel, index), {}, place);
  assert(after != jobs.begin());
  const Job& job = *(after - 1);
  assert(job.is_loose && job.pixel == pixel && index - job.first < job.count);
  const std::size_t at = job.loose_at + (index - job.first);
  return {radiance_[at], rays_[at]};
}

void StorePass::forget_loose() {
  radiance_ = std::vector<glm::vec3>();
  rays_ = std::vector<std::uint16_t>();
}

std::size_t StorePass::bytes() const {
  return radiance_.capacity() * sizeof(glm::vec3) + rays_.capacity() * sizeof(std::uint16_t);
}

}  // namespace quartet
