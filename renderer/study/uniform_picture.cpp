#include "renderer/study/uniform_picture.h"

#include <algorithm>
#include <atomic>

#include "renderer/base/cancel.h"
#include "renderer/base/parallel.h"
#include "renderer/trace/store/running_mean.h"

namespace quartet {
namespace {

/// Pixels that are asked for in one call: enough that eight paths at a time are busy.
constexpr std::size_t pixels_a_call = 32;

}  // namespace

UniformPicture uniform_picture(const SampleSource& source, int width, int height, std::uint32_t spp,
                               const std::stop_token& stop) {
  UniformPicture picture{RadianceImage(width, height), {}, 0};
  picture.rejected.assign(picture.image.size(), 0);
  std::atomic<std::uint64_t> work = 0;
  parallel_for(picture.image.size(), pixels_a_call, [&](std::size_t begin, std::size_t end) {
    std::vector<glm::vec3> samples(pixels_a_call * spp);
    std::vector<SampleJob> jobs;
    for (std::size_t first = begin; first < end; first += pixels_a_call) {
      check_cancelled(stop);
      const std::size_t count = std::min(pixels_a_call, end - first);
      jobs.clear();
      for (std::size_t i = 0; i < count; ++i) {
        const int pixel = int(first + i);
        jobs.push_back({pixel % width, pixel / width, 0, std::span(samples).subspan(i * spp, spp)});
      }
      source(jobs);
      for (std::size_t i = 0; i < count; ++i) {
        RunningMean mean;
        for (const glm::vec3& sample : jobs[i].radiance) {
          if (acceptable(sample)) {
            mean.add(sample);
          }
        }
        picture.image.pixels()[first + i] = mean.mean();
        picture.rejected[first + i] = spp - mean.count;
        work += std::uint64_t(jobs[i].work);
      }
    }
  });
  picture.work = work;
  return picture;
}

}  // namespace quartet
