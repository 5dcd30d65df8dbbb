#include "renderer/study/needs/model_pictures.h"

#include <array>
#include <atomic>

#include "renderer/adaptive/lab.h"
#include "renderer/base/cancel.h"
#include "renderer/base/interval.h"
#include "renderer/base/parallel.h"
#include "renderer/base/stopwatch.h"
#include "renderer/trace/store/running_mean.h"

namespace quartet {
namespace {

/// Pixels that are asked for in one call: enough that eight paths at a time are busy.
constexpr std::size_t pixels_a_call = 32;

/// One picture; what its samples took in rays is added to `rays`.
RadianceImage render_picture(const SampleSource& source, int width, int height, std::uint32_t spp,
                             const std::stop_token& stop, std::atomic<std::uint64_t>& rays,
                             std::vector<std::uint32_t>& rejected) {
  RadianceImage picture(width, height);
  rejected.assign(picture.size(), 0);
  parallel_for(picture.size(), pixels_a_call, [&](std::size_t begin, std::size_t end) {
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
        picture.pixels()[first + i] = mean.mean();
        rejected[first + i] = spp - mean.count;
        rays += std::uint64_t(jobs[i].work);
      }
    }
  });
  return picture;
}

}  // namespace

std::optional<ModelPictures> render_model(const Model& model, std::uint32_t spp,
                                          std::uint64_t first_seed, std::uint32_t seeds,
                                          std::stop_token stop,
                                          const std::function<void(double)>& progress) {
  ModelPictures pictures;
  std::atomic<std::uint64_t> rays = 0;
  std::vector<double> seconds;
  std::vector<std::uint32_t> rejected;
  try {
    const auto scene = std::make_shared<const TraceScene>(model.scene, stop);
    const std::vector<std::uint32_t> taken(
        std::size_t(model.scene.width) * std::size_t(model.scene.height), spp);
    for (std::uint32_t k = 0; k < seeds; ++k) {
      const RenderSettings settings = settings_of(model, first_seed + k);
      const Stopwatch watch;
      pictures.seeds.push_back(render_picture(sample_source(scene, settings), settings.width,
                                              settings.height, spp, stop, rays, rejected));
      seconds.push_back(watch.seconds());
      keep_most(pictures.rejected, rejected_of(rejected, taken, settings.seed));
      progress(double(k + 1) / double(seeds));
    }
  } catch (const Cancelled&) {
    return std::nullopt;
  }
  pictures.rays =
      double(rays) / (double(spp) * double(seeds) * double(pictures.seeds.front().size()));
  pictures.seconds = median(seconds);
  return pictures;
}

}  // namespace quartet
