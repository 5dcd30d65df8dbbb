#include <fmt/format.h>

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/options/run_options.h"
#include "app/records/json_text.h"
#include "app/records/scene_text.h"
#include "app/records/vector_json.h"
#include "renderer/base/printable.h"
#include "renderer/scene/mesh/mesh.h"
#include "renderer/scene/synthetic.h"
#include "renderer/trace/color_at.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

struct InfoOptions {
  std::string scene;
  std::vector<std::string> defines;
  bool as_json = false;
};

std::string_view kind_of(const Shape& shape) {
  return std::visit(
      [](const auto& geometry) -> std::string_view {
        using Geometry = std::decay_t<decltype(geometry)>;
        return std::is_same_v<Geometry, Mesh>     ? "mesh"
               : std::is_same_v<Geometry, Sphere> ? "sphere"
                                                  : "disk";
      },
      shape.geometry);
}

std::size_t triangles_of(const Shape& shape) {
  const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
  return mesh ? mesh->triangles.size() : 0;
}

std::string numbers(glm::vec3 v) {
  return v.x == v.y && v.y == v.z ? fmt::format("{:.4g}", v.x)
                                  : fmt::format("{:.4g} {:.4g} {:.4g}", v.x, v.y, v.z);
}

std::string color_text(const Scene& scene, const Color& color) {
  return color.texture == Color::no_texture
             ? numbers(color.value)
             : fmt::format("a checkerboard, {} on average", numbers(average_color(scene, color)));
}

std::string name_or(const std::string& id, std::string_view fallback) {
  return id.empty() ? fmt::format("({})", fallback) : id;
}

std::string material_text(const Scene& scene, const Material& material) {
  std::string text = fmt::format("{}, reflectance {}", material_name(material.kind),
                                 color_text(scene, material.reflectance));
  if (material.kind == MaterialKind::dielectric) {
    text += fmt::format(", index {:.4g}", material.ior);
  } else if (material.kind != MaterialKind::diffuse) {
    text += fmt::format(", eta {}, k {}", numbers(material.eta), numbers(material.k));
  }
  if (material.kind == MaterialKind::rough_conductor) {
    text += fmt::format(", GGX alpha {:.4g}", material.alpha);
  }
  return text + (material.two_sided ? ", two-sided" : "");
}

void print_camera(const Scene& scene) {
  const Camera& camera = scene.camera;
  fmt::print("camera      {} at {}, looking along {}, field of view {:.4g}°\n",
             camera.aperture_radius > 0.0f ? "thin lens" : "pinhole", numbers(camera.origin),
             numbers(camera.forward), camera.fov);
  if (camera.aperture_radius > 0.0f) {
    fmt::print("            aperture radius {:.4g}, in focus at {:.4g}\n", camera.aperture_radius,
               camera.focus_distance);
  }
}

void print_lights(const Scene& scene) {
  fmt::print("lights\n");
  for (const Shape& shape : scene.shapes) {
    if (shape.emits) {
      fmt::print("  {:<18} {}, area {:.4g}, radiance {}\n", name_or(shape.id, "no id"),
                 kind_of(shape), surface_area(shape), color_text(scene, shape.radiance));
    }
  }
  for (const PointLight& light : scene.points) {
    fmt::print("  {:<18} at {}, intensity {}\n", "(point)", numbers(light.position),
               numbers(light.intensity));
  }
  if (scene.environment != glm::vec3(0.0f)) {
    fmt::print("  {:<18} from all around, radiance {}\n", "(constant)", numbers(scene.environment));
  }
}

void print_text(const Scene& scene) {
  fmt::print("scene       {}\n", scene.name);
  if (const Synthetic* row = synthetic_of(scene)) {
    fmt::print(
        "samples     drawn, not traced: {}\nmean        {:.6g}, exact\nvariance    {:.6g}, "
        "exact\n",
        row->label, row->mean, row->variance);
    return;
  }
  fmt::print("file        {}\n", printable(scene.path.string()));
  fmt::print("picture     {}x{} pixels\n", scene.width, scene.height);
  fmt::print("depth       {}\n", scene.max_depth == std::numeric_limits<int>::max()
                                     ? std::string("not limited")
                                     : fmt::format("{} segments", scene.max_depth));
  print_camera(scene);
  fmt::print("shapes\n");
  for (const Shape& shape : scene.shapes) {
    const std::size_t triangles = triangles_of(shape);
    const Material& material = scene.materials[std::size_t(shape.material)];
    fmt::print("  {:<18} {}{}, {}\n", name_or(shape.id, fmt::format("line {}", shape.line)),
               kind_of(shape), triangles > 0 ? fmt::format(" of {} triangles", triangles) : "",
               material_text(scene, material));
  }
  print_lights(scene);
  fmt::print("approximated or left out{}\n", scene.warnings.empty() ? ": nothing" : "");
  for (const std::string& warning : scene.warnings) {
    fmt::print("  {}\n", warning);
  }
}

ordered_json json_of(const Scene& scene) {
  ordered_json json;
  json["scene"] = scene.name;
  json["file"] = scene.path.string();
  json["width"] = scene.width;
  json["height"] = scene.height;
  json["max_depth"] = scene.max_depth == std::numeric_limits<int>::max() ? -1 : scene.max_depth;
  if (const Synthetic* row = synthetic_of(scene)) {
    json["synthetic"] = {{"id", row->id}, {"mean", row->mean}, {"variance", row->variance}};
  }
  json["camera"] = {{"origin", vector_json(scene.camera.origin)},
                    {"forward", vector_json(scene.camera.forward)},
                    {"up", vector_json(scene.camera.up)},
                    {"fov", scene.camera.fov},
                    {"aperture_radius", scene.camera.aperture_radius},
                    {"focus_distance", scene.camera.focus_distance}};
  json["shapes"] = ordered_json::array();
  for (const Shape& shape : scene.shapes) {
    const Material& material = scene.materials[std::size_t(shape.material)];
    ordered_json entry = {{"id", shape.id},
                          {"kind", kind_of(shape)},
                          {"triangles", triangles_of(shape)},
                          {"area", surface_area(shape)},
                          {"material", material_name(material.kind)},
                          {"two_sided", material.two_sided}};
    if (shape.emits) {
      entry["radiance"] = vector_json(average_color(scene, shape.radiance));
    }
    json["shapes"].push_back(std::move(entry));
  }
  json["points"] = ordered_json::array();
  for (const PointLight& light : scene.points) {
    json["points"].push_back(
        {{"position", vector_json(light.position)}, {"intensity", vector_json(light.intensity)}});
  }
  json["environment"] = vector_json(scene.environment);
  json["warnings"] = scene.warnings;
  return json;
}

void run_info(const InfoOptions& options) {
  const Scene scene = open_scene(options.scene, parse_defines(options.defines));
  if (options.as_json) {
    fmt::print("{}\n", json_text(json_of(scene)));
  } else {
    print_text(scene);
  }
}

}  // namespace

void add_info_command(CLI::App& app, const Program&) {
  CLI::App* command =
      app.add_subcommand("info", "What a scene holds, and what of its file was approximated");
  const auto options = std::make_shared<InfoOptions>();
  command
      ->add_option("scene", options->scene,
                   "A Mitsuba 3 XML file, the name of a built-in scene, or synthetic:ID")
      ->required();
  command->add_option("-D", options->defines, "A parameter of the scene file: name=value")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--json", options->as_json, "As JSON");
  command->footer("Examples:\n  quartet info cornell-checker\n  quartet info synthetic:pareto");
  command->callback([options] { run_info(*options); });
}

}  // namespace quartet
