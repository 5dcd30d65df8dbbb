#include "renderer/scene/xml/shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

#include "renderer/base/cancel.h"
#include "renderer/base/excerpt.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/mesh/mesh.h"
#include "renderer/scene/mesh/obj_file.h"
#include "renderer/scene/xml/element.h"
#include "renderer/scene/xml/light.h"
#include "renderer/scene/xml/material.h"

namespace quartet {
namespace {

using Geometry = std::variant<Mesh, Sphere, Disk>;

/// Whether `a` and `b` are as long and at right angles, as the axes of a circle must be.
bool are_circle_axes(const glm::dvec3& a, const glm::dvec3& b) {
  constexpr double tolerance = 1e-4;  // matrices in files have about six digits
  const double length = std::max(glm::length(a), glm::length(b));
  return std::abs(glm::length(a) - glm::length(b)) <= tolerance * length &&
         std::abs(glm::dot(a, b)) <= tolerance * length * length;
}

Geometry rectangle(SceneBuilder& /*builder*/, Element& element) {
  return make_rectangle(element.transform("to_world"), element.boolean("flip_normals", false));
}

Geometry cube(SceneBuilder& /*builder*/, Element& element) {
  return make_cube(element.transform("to_world"), element.boolean("face_normals", false),
                   element.boolean("flip_normals", false));
}

Geometry sphere(SceneBuilder& /*builder*/, Element& element) {
  const glm::dmat4 to_world = element.transform("to_world");
  const glm::dvec3 center = element.point("center", glm::dvec3(0.0));
  const double radius = element.positive("radius", 1.0);
  const glm::dmat3 linear = glm::dmat3(to_world) * radius;
  if (!are_circle_axes(linear[0], linear[1]) || !are_circle_axes(linear[1], linear[2]) ||
      !are_circle_axes(linear[2], linear[0])) {
    element.fail(
        "to_world of a sphere scales unevenly or shears, expected the same scale in x, y "
        "and z");
  }
  const double determinant = glm::determinant(linear);
  const double world_radius = std::cbrt(std::abs(determinant));
  // Mitsuba takes a mirroring as a negative radius, which exchanges inside and outside.
  const bool mirrored = determinant < 0.0;
  Sphere result;
  result.center = glm::vec3(to_world * glm::dvec4(center, 1.0));
  result.radius = float(world_radius);
  result.flip_normals = element.boolean("flip_normals", false) != mirrored;
  result.to_local = glm::mat3(glm::inverse(linear) * (mirrored ? -world_radius : world_radius));
  return result;
}

Geometry disk(SceneBuilder& /*builder*/, Element& element) {
  const glm::dmat4 to_world = element.transform("to_world");
  const glm::dmat3 linear(to_world);
  if (!are_circle_axes(linear[0], linear[1])) {
    element.fail(
        "to_world of a disk scales unevenly or shears, expected the same scale in x and y");
  }
  const glm::dvec3 normal =
      glm::normalize(glm::transpose(glm::inverse(linear)) * glm::dvec3(0.0, 0.0, 1.0));
  Disk result;
  result.center = glm::vec3(to_world[3]);
  result.normal = glm::vec3(element.boolean("flip_normals", false) ? -normal : normal);
  result.axis_u = glm::vec3(glm::normalize(linear[0]));
  result.axis_v = glm::vec3(glm::normalize(linear[1]));
  result.radius = float(glm::length(linear[0]));
  return result;
}

Geometry obj(SceneBuilder& builder, Element& element) {
  const std::string filename = element.text("filename", "");
  if (filename.empty()) element.fail("shape 'obj' has no filename");
  const glm::dmat4 to_world = element.transform("to_world");
  const bool face_normals = element.boolean("face_normals", false);
  ObjFile file;
  try {
    file = read_obj(builder.xml.path().parent_path() / filename, builder.stop);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::runtime_error& error) {
    builder.xml.fail(element.property("filename", {"string"}), error.what());
  }
  const std::string name = excerpt(filename);
  for (const std::string& warning : file.warnings) {
    element.warn(fmt::format("{}: {}", name, warning));
  }
  Mesh& mesh = file.mesh;
  if (element.boolean("flip_tex_coords", true)) {
    for (glm::vec2& uv : mesh.uvs) uv.y = 1.0f - uv.y;
  }
  transform(mesh, to_world, builder.stop);
  if (const std::size_t dropped = drop_degenerate_triangles(mesh, builder.stop); dropped > 0) {
    element.warn(fmt::format("{} triangles without area in {} are left out", dropped, name));
  }
  if (mesh.triangles.empty()) {
    element.fail(fmt::format("mesh {} has no triangles with an area", name));
  }
  if (face_normals) {
    mesh.normals.clear();
  } else if (mesh.normals.empty()) {
    compute_normals(mesh, builder.stop);
  } else {
    orient_by_normals(mesh, builder.stop);
  }
  if (element.boolean("flip_normals", false)) flip(mesh);
  return std::move(mesh);
}

struct ShapeType {
  std::string_view name;
  Geometry (*read)(SceneBuilder&, Element&);
};

constexpr std::array shape_types = {
    ShapeType{"rectangle", rectangle}, ShapeType{"cube", cube}, ShapeType{"sphere", sphere},
    ShapeType{"disk", disk},           ShapeType{"obj", obj},
};

bool is_textured(const Scene& scene, const Shape& shape) {
  const Material& material = scene.materials[std::size_t(shape.material)];
  return material.reflectance.texture != Color::no_texture ||
         material.transmittance.texture != Color::no_texture ||
         (shape.emits && shape.radiance.texture != Color::no_texture);
}

void check_geometry(SceneBuilder& builder, const Element& element, const Shape& shape) {
  if (const std::string fault = geometry_fault(shape); !fault.empty()) {
    element.fail(fmt::format("{}: {}", element.title(), fault));
  }
  const Mesh* const mesh = std::get_if<Mesh>(&shape.geometry);
  if (mesh) builder.count_triangles(element.node(), mesh->triangles.size());
  if (!shape.emits) return;
  builder.count_lights(element.node(), mesh ? mesh->triangles.size() : 1);
  if (!(surface_area(shape) > 0.0)) element.fail("a light without area");
}

}  // namespace

void read_shape(SceneBuilder& builder, pugi::xml_node node) {
  if (builder.scene.shapes.size() == most_shapes) {
    builder.xml.fail(node, fmt::format("more than {} shapes, which is the limit", most_shapes));
  }
  Element element(builder, node);
  const auto* const type =
      std::find_if(shape_types.begin(), shape_types.end(),
                   [&](const ShapeType& candidate) { return candidate.name == element.type(); });
  if (type == shape_types.end()) {
    element.warn(fmt::format("{} is not known and left out", element.title()));
    return;
  }
  Shape shape;
  shape.id = element.id();
  shape.line = builder.xml.line(node);
  const auto lights = element.objects("emitter");
  if (lights.size() > 1) element.fail("a shape with two emitters, expected at most one");
  if (!lights.empty()) read_shape_light(builder, lights[0], shape);
  shape.geometry = type->read(builder, element);
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
