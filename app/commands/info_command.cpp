#include <fmt/format.h>

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/options/run_options.h"
#include "app/records/json_text.h"
#include "app/records/vector_json.h"
#include "renderer/base/number_text.h"
#include "renderer/base/printable.h"
#include "renderer/scene/synthetic.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

struct InfoOptions {
  std::string scene;
  std::vector<std::string> defines;
  bool as_json = false;
};

std::size_t triangles_of(const Shape& shape) {
  const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
  return mesh ? mesh->triangles.size() : 0;
}

std::string name_or(const std::string& id, std::string_view fallback) {
  return id.empty() ? fmt::format("({})", fallback) : id;
}

void print_camera(const Scene& scene) {
  const Camera& camera = scene.camera;
  fmt::print("camera      {} at {}, looking along {}, field of view {:.4g}°\n",
             camera.aperture_radius > 0.0f ? "thin lens" : "pinhole", vector_text(camera.origin),
             vector_text(camera.forward), camera.fov);
  if (camera.aperture_radius > 0.0f) {
    fmt::print("            aperture radius {:.4g}, in focus at {:.4g}\n", camera.aperture_radius,
               camera.focus_distance);
  }
}

void print_lights(const Scene& scene) {
  const auto print_light = []<class Kind>(const Kind& light) {
    fmt::print("  {:<18} {}\n", fmt::format("({})", Kind::name), light.text());
  };
  fmt::print("lights\n");
  for (const Shape& shape : scene.shapes) {
    if (shape.emits) {
      fmt::print("  {:<18} {}, area {:.4g}, radiance {}\n", name_or(shape.id, "no id"),
                 shape_name(shape), surface_area(shape),
                 color_text(scene.textures, shape.radiance));
    }
  }
  for (const DeltaLight& light : scene.delta_lights) {
    std::visit(print_light, light);
  }
  if (shines(scene.environment)) {
    std::visit(print_light, scene.environment);
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
    const Material& material = scene.materials[std::size_t(shape.material)];
    fmt::print("  {:<18} {}, {}\n", name_or(shape.id, fmt::format("line {}", shape.line)),
               shape_text(shape), material_text(scene.textures, material));
  }
  print_lights(scene);
  fmt::print("approximated or left out{}\n", scene.warnings.empty() ? ": nothing" : "");
  for (const std::string& warning : scene.warnings) {
    fmt::print("  {}\n", warning);
  }
}

void add_json(const PointLight& light, ordered_json& json) {
  json["points"].push_back(
      {{"position", vector_json(light.position)}, {"intensity", vector_json(light.intensity)}});
}

void add_json(const ConstantEnvironment& environment, ordered_json& json) {
  json["environment"] = vector_json(environment.radiance);
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
                          {"kind", shape_name(shape)},
                          {"triangles", triangles_of(shape)},
                          {"area", surface_area(shape)},
                          {"material", material_name(material)},
                          {"two_sided", material.two_sided}};
    if (shape.emits) {
      entry["radiance"] = vector_json(average_color(scene.textures, shape.radiance));
    }
    json["shapes"].push_back(std::move(entry));
  }
  json["points"] = ordered_json::array();
  for (const DeltaLight& light : scene.delta_lights) {
    std::visit([&](const auto& kind) { add_json(kind, json); }, light);
  }
  std::visit([&](const auto& kind) { add_json(kind, json); }, scene.environment);
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
