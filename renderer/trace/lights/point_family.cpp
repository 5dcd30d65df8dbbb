#include <cmath>

#include "renderer/base/image.h"
#include "renderer/base/math/warp.h"
#include "renderer/trace/lights/light.h"

namespace quartet {
namespace {

LightSample sample_point(const Light& light, const Scene& /*scene*/, glm::vec3 from, float /*u*/,
                         float /*v*/) {
  const glm::vec3 to_light = light.row.origin - from;
  const float distance2 = glm::dot(to_light, to_light);
  const float distance = std::sqrt(distance2);
  return {.direction = to_light * (1.0f / distance),
          .distance = distance,
          .radiance = light.row.radiance * (1.0f / distance2),
          .pdf = light.probability,
          .is_point = true};
}

/// 4π I.
double point_power(const Light& light, const Scene& /*scene*/, float /*radius*/) {
  return 4.0 * pi * luminance(light.row.radiance);
}

constexpr LightFamily point_family{sample_point, nullptr, point_power};

}  // namespace

void add_lights(const PointLight& point, std::vector<Light>& lights) {
  if (luminance(point.intensity) > 0.0f) {
    lights.push_back({.row = {.origin = point.position, .radiance = point.intensity},
                      .family = &point_family,
                      .domain = LightDomain::point});
  }
}

}  // namespace quartet
