#include "renderer/trace/trace_scene.h"

namespace quartet {
namespace {

bool is_textured(const Shape& shape, const Material& material) {
  const auto textured = [](const Color& color) { return color.texture != Color::no_texture; };
  return textured(material.reflectance) || textured(material.transmittance) ||
         (shape.emits && textured(shape.radiance));
}

}  // namespace

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
    record.textured = is_textured(shape, material);
    record.plain =
        mesh && !record.smooth && !record.textured && material.kind == MaterialKind::diffuse;
    record.emits = shape.emits;
    record.two_sided = record.material->two_sided;
    if (record.plain) {
      for (Facet& facet : record.facets) {
        facet.reflectance = material.reflectance.value;
      }
    }
  }
}

Surface TraceScene::surface_without_facets(const ShapeRecord& record, const Ray& ray,
                                           const Hit& hit) {
  if (const Sphere* sphere = std::get_if<Sphere>(&record.shape->geometry)) {
    return surface_at(*sphere, ray, hit);
  }
  return surface_at(std::get<Disk>(record.shape->geometry), ray, hit);
}

}  // namespace quartet
