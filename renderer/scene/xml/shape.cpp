#include "renderer/scene/xml/shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "renderer/scene/limits.h"
#include "renderer/scene/shapes/shape_rows.h"
#include "renderer/scene/xml/element.h"
#include "renderer/scene/xml/light.h"
#include "renderer/scene/xml/material.h"

namespace quartet {
namespace {

bool is_textured(const Scene& scene, const Shape& shape) {
  return is_textured(scene.materials[std::size_t(shape.material)]) ||
         (shape.emits && shape.radiance.is_textured());
}

void check_geometry(SceneBuilder& builder, const Element& element, const Shape& shape) {
  if (const std::string fault = geometry_fault(shape); !fault.empty()) {
    element.fail(fmt::format("{}: {}", element.title(), fault));
  }
  if (const Mesh* const mesh = std::get_if<Mesh>(&shape.geometry)) {
    builder.count_triangles(element.node(), mesh->triangles.size());
  }
  if (!shape.emits) return;
  const auto pieces = [](const auto& geometry) { return geometry.pieces(); };
  builder.count_lights(element.node(), std::visit(pieces, shape.geometry));
  if (!(surface_area(shape) > 0.0)) element.fail("a light without area");
}

}  // namespace

void read_shape(SceneBuilder& builder, pugi::xml_node node) {
  if (builder.scene.shapes.size() == most_shapes) {
    builder.xml.fail(node, fmt::format("more than {} shapes, which is the limit", most_shapes));
  }
  Element element(builder, node);
  const auto* const row =
      std::find_if(shape_rows.begin(), shape_rows.end(),
                   [&](const ShapeRow* candidate) { return candidate->type == element.type(); });
  if (row == shape_rows.end()) {
    element.warn(fmt::format("{} is not known and left out", element.title()));
    return;
  }
  Shape shape;
  shape.id = element.id();
  shape.line = builder.xml.line(node);
  const auto lights = element.objects("emitter");
  if (lights.size() > 1) element.fail("a shape with two emitters, expected at most one");
  if (!lights.empty()) read_shape_light(builder, lights[0], shape);
  shape.geometry = (*row)->read(builder, element);
  check_geometry(builder, element, shape);

  const auto materials = element.objects("bsdf");
  if (materials.size() > 1) element.warn("a shape with two bsdfs: the first one is used");
  shape.material =
      materials.empty() ? default_material(builder) : read_material(builder, materials[0]);
  if (Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
    if (mesh->uvs.empty() && is_textured(builder.scene, shape)) {
      make_barycentric_uvs(*mesh, builder.stop);
    }
  }
  element.ignore({"silhouette_sampling_weight"});
  element.warn_unused();
  builder.scene.shapes.push_back(std::move(shape));
}

}  // namespace quartet
