#include "renderer/trace/trace_scene.h"

namespace quartet {

TraceScene::TraceScene(Scene scene, const std::stop_token& stop)
    : scene_(std::move(scene)),
      accel_(scene_, stop),
      lights_(scene_, accel_.bounds_min(), accel_.bounds_max()) {
  for (const Shape& shape : scene_.shapes) {
    const Material& material = scene_.materials[std::size_t(shape.material)];
    const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
    ShapeRecord& record = records_.emplace_back();
    record.shape = &shape;
    record.material = &material;
    record.facets = mesh ? facets_of(*mesh, stop) : std::vector<Facet>();
    record.smooth = mesh && !mesh->normals.empty();
    record.textured = is_textured(material) || (shape.emits && shape.radiance.is_textured());
    const Diffuse* diffuse = std::get_if<Diffuse>(&material.kind);
    record.plain = mesh && diffuse && !record.smooth && !record.textured;
    record.emits = shape.emits;
    record.two_sided = material.two_sided;
    if (record.plain) {
      for (Facet& facet : record.facets) {
        facet.reflectance = diffuse->reflectance.value;
      }
    }
  }
}

Surface TraceScene::surface_without_facets(const ShapeRecord& record, const Ray& ray,
                                           const Hit& hit) {
  return std::visit(
      [&]<class Kind>(const Kind& geometry) {
        if constexpr (std::is_same_v<Kind, Mesh>) {
          return surface_at(record.facets[hit.primitive], hit);
        } else {
          return surface_at(geometry, ray, hit);
        }
      },
      record.shape->geometry);
}

}  // namespace quartet
