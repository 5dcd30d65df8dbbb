#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "renderer/base/cancel.h"
#include "renderer/base/excerpt.h"
#include "renderer/scene/mesh/obj_file.h"
#include "renderer/scene/shapes/shape_rows.h"
#include "renderer/scene/xml/element.h"

namespace quartet {
namespace {

Geometry read_obj_shape(SceneBuilder& builder, Element& element) {
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

}  // namespace

constexpr ShapeRow obj_row{"obj", read_obj_shape};

}  // namespace quartet
