#include "renderer/study/scaled_radiance.h"

#include <utility>

namespace quartet {

SampleSource scaled(SampleSource source, const glm::vec3& factor) {
  return [source = std::move(source), factor](std::span<SampleJob> jobs) {
    source(jobs);
    for (SampleJob& job : jobs) {
      for (glm::vec3& sample : job.radiance) {
        sample *= factor;
      }
    }
  };
}

RadianceImage scaled(RadianceImage image, const glm::vec3& factor) {
  for (glm::vec3& pixel : image.pixels()) {
    pixel *= factor;
  }
  return image;
}

}  // namespace quartet
