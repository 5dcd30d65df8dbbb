#include <limits>

#include "renderer/base/image.h"
#include "renderer/base/math/warp.h"
#include "renderer/trace/lights/light.h"

namespace quartet {
namespace {

LightSample sample_environment(const Light& light, const Scene& /*scene*/, glm::vec3 /*from*/,
                               float u, float v) {
  return {.direction = square_to_uniform_cap(u, v, -1.0f),
          .distance = std::numeric_limits<float>::infinity(),
          .radiance = light.row.radiance,
          .pdf = light.probability * (1.0f / (4.0f * pi)),
          .is_point = false};
}

/// π R² L goes through the scene from each of 4π directions.
double environment_power(const Light& light, const Scene& /*scene*/, float radius) {
  return 4.0 * pi * pi * radius * radius * luminance(light.row.radiance);
}

constexpr LightFamily environment_family{sample_environment, nullptr, environment_power};

}  // namespace

void add_lights(const ConstantEnvironment& environment, std::vector<Light>& lights) {
  if (luminance(environment.radiance) > 0.0f) {
    lights.push_back({.row = {.radiance = environment.radiance}, .family = &environment_family});
  }
}

}  // namespace quartet
