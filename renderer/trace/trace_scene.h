#pragma once

#include <stop_token>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/trace/accel.h"
#include "renderer/trace/bsdf.h"
#include "renderer/trace/light_sampler.h"
#include "renderer/trace/surface.h"

namespace quartet {

/// A scene made ready for tracing: its hierarchy, its lights, and what each shape needs. Immutable;
/// safe to use from many threads.
class TraceScene {
 public:
  /// Throws std::runtime_error if the hierarchy cannot be built, Cancelled within a tenth of a
  /// second or so after `stop` was asked for.
  explicit TraceScene(Scene scene, const std::stop_token& stop = {});
  TraceScene(const TraceScene&) = delete;
  TraceScene& operator=(const TraceScene&) = delete;

  const Scene& scene() const { return scene_; }
  const Accel& accel() const { return accel_; }
  const LightSampler& lights() const { return lights_; }

  /// The facet that was hit, if it says everything of the surface: flat, of one diffuse colour.
  /// Else null.
  const Facet* plain_facet(std::uint32_t shape, std::uint32_t primitive) const {
    const ShapeRecord& record = records_[shape];
    return record.plain ? &record.facets[primitive] : nullptr;
  }
  bool emits(std::uint32_t shape) const { return records_[shape].emits; }
  bool two_sided(std::uint32_t shape) const { return records_[shape].two_sided; }

  Surface surface(const Ray& ray, const Hit& hit) const {
    const ShapeRecord& record = records_[hit.shape];
    Surface surface = record.facets.empty() ? surface_without_facets(record, ray, hit)
                                            : surface_at(record.facets[hit.primitive], hit);
    if (record.smooth) {
      interpolate_normal(std::get<Mesh>(record.shape->geometry), ray, hit, surface);
    }
    if (record.textured) {
      surface.uv = uv_at(*record.shape, surface.position, hit);
    }
    return surface;
  }
  Bsdf bsdf(const Surface& surface) const {
    return bsdf_at(scene_, *records_[surface.shape].material, surface.uv);
  }
  /// Radiance that the surface itself sends against `direction`; only its front shines.
  glm::vec3 emitted(const Surface& surface, glm::vec3 direction) const {
    const ShapeRecord& record = records_[surface.shape];
    return record.emits && glm::dot(direction, surface.normal) < 0.0f
               ? color_at(scene_.textures, record.shape->radiance, surface.uv)
               : glm::vec3(0.0f);
  }
  /// Radiance that arrives against `direction`, of one ray or eight, where no shape is met.
  template <class Vector>
  Vector environment(const Vector& direction) const {
    return std::visit([&](const auto& kind) { return kind.at(direction); }, scene_.environment);
  }

 private:
  /// What each hit asks of a shape; one a shape.
  struct ShapeRecord {
    const Shape* shape;
    const Material* material;
    std::vector<Facet> facets;  // of a mesh
    bool smooth;                // a mesh with normals
    bool textured;              // some colour of it depends on uv
    bool plain;                 // neither, and diffuse
    bool emits;
    bool two_sided;
  };

  static Surface surface_without_facets(const ShapeRecord& record, const Ray& ray, const Hit& hit);

  Scene scene_;
  Accel accel_;
  LightSampler lights_;
  std::vector<ShapeRecord> records_;
};

}  // namespace quartet
