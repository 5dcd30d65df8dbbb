#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>
#include <variant>

#include "renderer/scene/write_scene.h"
#include "renderer/scene/xml/element_writer.h"
#include "renderer/scene/xml/rounded.h"

namespace quartet {
namespace {

/// Three axes as they were before each was rounded to single precision.
glm::dmat3 unit_axes(const glm::vec3& x, const glm::vec3& y, const glm::vec3& z) {
  const std::array axes = rounded_to(
      std::array{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}, [](std::array<double, 9>& values) {
        for (std::size_t i = 0; i < values.size(); i += 3) {
          const glm::dvec3 axis =
              glm::normalize(glm::dvec3(values[i], values[i + 1], values[i + 2]));
          for (int c = 0; c < 3; ++c) values[i + std::size_t(c)] = axis[c];
        }
      });
  return {axes[0], axes[1], axes[2], axes[3], axes[4], axes[5], axes[6], axes[7], axes[8]};
}

std::string_view fov_axis_name(FovAxis axis) {
  switch (axis) {
    case FovAxis::x:
      return "x";
    case FovAxis::y:
      return "y";
    case FovAxis::diagonal:
      return "diagonal";
    case FovAxis::smaller:
      return "smaller";
    case FovAxis::larger:
      return "larger";
  }
  return "";
}

void write_sensor(ElementWriter& root, const Scene& scene) {
  const Camera& camera = scene.camera;
  const bool lens = camera.aperture_radius > 0.0f;
  ElementWriter sensor = root.object("sensor", lens ? "thinlens" : "perspective");
  sensor.number("fov", camera.fov);
  sensor.text("fov_axis", fov_axis_name(camera.fov_axis));
  if (lens) {
    sensor.number("aperture_radius", camera.aperture_radius);
    sensor.number("focus_distance", camera.focus_distance);
  }
  // A camera that looks along +z with +y up has +x on its left.
  const glm::dmat3 axes = unit_axes(-camera.right, camera.up, camera.forward);
  glm::dmat4 to_world(axes);
  to_world[3] = glm::dvec4(glm::dvec3(camera.origin), 1.0);
  sensor.transform("to_world", to_world);
  ElementWriter film = sensor.object("film", "hdrfilm");
  film.integer("width", scene.width);
  film.integer("height", scene.height);
  film.object("rfilter", "box");
}

bool is_shared(const Scene& scene, std::size_t material) {
  return std::ranges::count(scene.shapes, int(material), &Shape::material) > 1;
}

void write_material(ElementWriter& shape, std::size_t index) {
  SceneWriting& writing = shape.writing();
  std::string& id = writing.material_ids[index];
  if (!id.empty()) return shape.refer(id);
  const Material& material = writing.scene.materials[index];
  ElementWriter bsdf = shape.object("bsdf", material.two_sided ? "twosided" : "");
  if (!material.id.empty() || is_shared(writing.scene, index)) {
    id = writing.new_id(material.id.empty() ? fmt::format("material-{}", index + 1) : material.id);
    bsdf.set_id(id);
  }
  ElementWriter inner = material.two_sided ? bsdf.object("bsdf") : bsdf;
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        inner.set_type(Kind::name);
        kind.write(inner);
      },
      material.kind);
}

void write_shape(ElementWriter& root, const Shape& shape) {
  ElementWriter element = root.object("shape");
  std::visit([&](const auto& kind) { kind.write(element); }, shape.geometry);
  if (!shape.id.empty()) element.set_id(root.writing().new_id(shape.id));
  write_material(element, std::size_t(shape.material));
  if (shape.emits) element.object("emitter", "area").color("radiance", shape.radiance);
}

template <class Family>
void write_light(ElementWriter& root, const Family& light) {
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        if (!kind.shines()) return;
        ElementWriter emitter = root.object("emitter", Kind::name);
        kind.write(emitter);
      },
      light);
}

}  // namespace

std::vector<SceneFile> scene_files(const Scene& scene, const std::string& stem) {
  SceneWriting writing{.scene = scene,
                       .stem = stem,
                       .meshes = {},
                       .texture_ids = std::vector<std::string>(scene.textures.size()),
                       .material_ids = std::vector<std::string>(scene.materials.size()),
                       .ids = {}};
  pugi::xml_document document;
  ElementWriter root(writing, document.append_child("scene"));
  document.document_element().append_attribute("version").set_value("3.0.0");
  const bool endless = scene.max_depth == std::numeric_limits<int>::max();
  root.object("integrator", "path").integer("max_depth", endless ? -1 : scene.max_depth);
  write_sensor(root, scene);
  write_light(root, scene.environment);
  for (const DeltaLight& light : scene.delta_lights) write_light(root, light);
  // The loader numbers materials as shapes use them first, and so they are numbered here.
  for (const Shape& shape : scene.shapes) write_shape(root, shape);
  std::ostringstream text;
  document.save(text, "  ");
  std::vector<SceneFile> files{{stem + ".xml", text.str()}};
  for (SceneFile& mesh : writing.meshes) files.push_back(std::move(mesh));
  return files;
}

}  // namespace quartet
