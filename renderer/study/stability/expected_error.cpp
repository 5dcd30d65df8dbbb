#include "renderer/study/stability/expected_error.h"

#include <vector>

#include "renderer/adaptive/lab.h"
#include "renderer/study/stability/truth.h"
#include "renderer/study/uniform_picture.h"

namespace quartet {
std::shared_ptr<const RadianceImage> expected_errors(const std::shared_ptr<const TraceScene>& scene,
                                                     const RenderSettings& settings,
                                                     const RadianceImage& truth, std::uint32_t spp,
                                                     std::uint32_t runs,
                                                     const std::function<bool()>& go_on) {
  auto expected = std::make_shared<RadianceImage>(settings.width, settings.height);
  RenderSettings hidden = settings;
  for (std::uint32_t run = 0; run < runs; ++run) {
    hidden.seed = (std::uint64_t(1) << 63) + run;
    const UniformPicture picture =
        uniform_picture(sample_source(scene, hidden), settings.width, settings.height, spp);
    const std::vector<float> errors = squared_errors(picture.image, truth);
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
