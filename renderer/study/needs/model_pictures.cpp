#include "renderer/study/needs/model_pictures.h"

#include <utility>

#include "renderer/adaptive/lab.h"
#include "renderer/base/cancel.h"
#include "renderer/base/interval.h"
#include "renderer/base/stopwatch.h"
#include "renderer/study/uniform_picture.h"

namespace quartet {
std::optional<ModelPictures> render_model(const Model& model, std::uint32_t spp,
                                          std::uint64_t first_seed, std::uint32_t seeds,
                                          std::stop_token stop,
                                          const std::function<void(double)>& progress) {
  ModelPictures pictures;
  std::uint64_t rays = 0;
  std::vector<double> seconds;
  try {
    const auto scene = std::make_shared<const TraceScene>(model.scene, stop);
    const std::vector<std::uint32_t> taken(
        std::size_t(model.scene.width) * std::size_t(model.scene.height), spp);
    for (std::uint32_t k = 0; k < seeds; ++k) {
      const RenderSettings settings = settings_of(model, first_seed + k);
      const Stopwatch watch;
      UniformPicture picture = uniform_picture(sample_source(scene, settings), settings.width,
                                               settings.height, spp, stop);
      seconds.push_back(watch.seconds());
      rays += picture.work;
      pictures.seeds.push_back(std::move(picture.image));
      keep_most(pictures.rejected, rejected_of(picture.rejected, taken, settings.seed));
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
