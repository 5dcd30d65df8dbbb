#pragma once

#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/trace/accel.h"
#include "renderer/trace/bsdf.h"
#include "renderer/trace/lights.h"
#include "renderer/trace/surface.h"

namespace quartet {

/// A scene made ready for tracing: its hierarchy, its lights, and what each shape needs. Immutable;
/// safe to use from many threads.
class TraceScene {
 public:
  /// Throws std::runtime_error if the hierarchy cannot be built.
  explicit TraceScene(Scene scene);
  TraceScene(const TraceScene&) = delete;
  TraceScene& operator=(const TraceScene&) = delete;

  const Scene& scene() const { return scene_; }
  const Accel& accel() const { return accel_; }
  const Lights& lights() const { return lights_; }

  Surface surface(const Ray& ray, const Hit& hit) const {
    return surface_at(scene_.shapes[hit.shape], needs_uv_[hit.shape] != 0, ray, hit);
  }
  Bsdf bsdf(const Surface& surface) const {
    const int material = scene_.shapes[surface.shape].material;
    return bsdf_at(scene_, scene_.materials[std::size_t(material)], surface.uv);
  }
  /// Radiance that the surface itself sends against `direction`; only its front shines.
  glm::vec3 emitted(const Surface& surface, glm::vec3 direction) const;

 private:
  Scene scene_;
  Accel accel_;
  Lights lights_;
  std::vector<char> needs_uv_;
};

}  // namespace quartet
