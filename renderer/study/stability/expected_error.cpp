#include "renderer/study/stability/expected_error.h"

#include <vector>

#include "renderer/adaptive/lab.h"
#include "renderer/base/parallel.h"
#include "renderer/study/stability/truth.h"
#include "renderer/trace/store/running_mean.h"

namespace quartet {
namespace {

RadianceImage picture_of(const SampleSource& source, int width, int height, std::uint32_t spp) {
  RadianceImage picture(width, height);
  parallel_for(std::size_t(height), 1, [&](std::size_t first, std::size_t last) {
    std::vector<glm::vec3> radiance(spp);
    for (std::size_t y = first; y < last; ++y) {
      for (int x = 0; x < width; ++x) {
        source(x, int(y), 0, radiance);
        RunningMean mean;
        for (const glm::vec3& sample : radiance) {
          if (acceptable(sample)) {
            mean.add(sample);
          }
        }
        picture.at(x, int(y)) = mean.mean();
      }
    }
  });
  return picture;
}

}  // namespace

std::shared_ptr<const RadianceImage> expected_errors(const std::shared_ptr<const TraceScene>& scene,
                                                     const RenderSettings& settings,
                                                     const RadianceImage& truth, std::uint32_t spp,
                                                     std::uint32_t runs,
                                                     const std::function<bool()>& go_on) {
  auto expected = std::make_shared<RadianceImage>(settings.width, settings.height);
  RenderSettings hidden = settings;
  for (std::uint32_t run = 0; run < runs; ++run) {
    hidden.seed = (std::uint64_t(1) << 63) + run;
    const std::vector<float> errors = squared_errors(
        picture_of(sample_source(scene, hidden), settings.width, settings.height, spp), truth);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      expected->pixels()[i] += glm::vec3(errors[i] * float(spp) / float(runs));
    }
    if (!go_on()) {
      return nullptr;
    }
  }
  return expected;
}

}  // namespace quartet
