#include "renderer/trace/trace_scene.h"

#include "renderer/trace/color_at.h"

namespace quartet {

TraceScene::TraceScene(Scene scene)
    : scene_(std::move(scene)),
      accel_(scene_),
      lights_(scene_, accel_.bounds_min(), accel_.bounds_max()) {
  for (const Shape& shape : scene_.shapes) {
    needs_uv_.push_back(char(needs_uv(scene_, shape)));
  }
}

glm::vec3 TraceScene::emitted(const Surface& surface, glm::vec3 direction) const {
  const Shape& shape = scene_.shapes[surface.shape];
  if (!shape.emits || glm::dot(direction, surface.normal) >= 0.0f) {
    return glm::vec3(0.0f);
  }
  return color_at(scene_, shape.radiance, surface.uv);
}

}  // namespace quartet
