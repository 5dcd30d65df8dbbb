#include "renderer/trace/lights/light.h"

#include <cmath>

#include "renderer/base/image.h"
#include "renderer/base/math/warp.h"

namespace quartet {

float area_pdf(const Light& light, const Surface& surface, glm::vec3 direction, float distance) {
  const float cos_light = std::abs(glm::dot(direction, surface.normal));
  return cos_light > 0.0f ? light.row.density * distance * distance / cos_light : 0.0f;
}

double area_power(const Light& light, const Scene& scene, float /*radius*/) {
  return pi * light.area *
         luminance(average_color(scene.textures, scene.shapes[light.shape].radiance));
}

glm::vec3 radiance_at(const Light& light, const Scene& scene, glm::vec3 position, const Hit& hit) {
  const Shape& shape = scene.shapes[light.shape];
  return shape.radiance.is_textured()
             ? color_at(scene.textures, shape.radiance, uv_at(shape, position, hit))
             : shape.radiance.value;
}

}  // namespace quartet
