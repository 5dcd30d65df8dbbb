#include "renderer/scene/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "renderer/base/cancel.h"
#include "renderer/base/excerpt.h"
#include "renderer/base/printable.h"
#include "renderer/scene/xml/element.h"
#include "renderer/scene/xml/light.h"
#include "renderer/scene/xml/scene_builder.h"
#include "renderer/scene/xml/sensor.h"
#include "renderer/scene/xml/shape.h"

namespace quartet {
namespace {

void read_integrator(SceneBuilder& builder, pugi::xml_node node) {
  const OpenElement open(builder, node);
  if (!builder.integrators.insert(node).second) return;
  Element element(builder, node);
  // An integrator may wrap the one that computes radiance (aov, moment).
  for (pugi::xml_node inner : element.objects("integrator")) read_integrator(builder, inner);
  if (element.type() != "path" && element.type() != "volpath") {
    element.warn(fmt::format("{} becomes a path tracer", element.title()));
  }
  if (element.has("max_depth")) {
    const int depth = element.integer("max_depth", -1);
    if (depth == 0 || depth < -1) {
      element.fail(fmt::format("max_depth is {}, expected -1 (no limit) or at least 1", depth));
    }
    builder.scene.max_depth = depth < 0 ? std::numeric_limits<int>::max() : depth;
  }
  if (element.boolean("hide_emitters", false)) element.warn("hide_emitters is left out");
  element.ignore({"rr_depth", "samples_per_pass", "block_size", "timeout"});
  element.warn_unused();
}

void skip(SceneBuilder& /*builder*/, pugi::xml_node /*node*/) {
}

struct PartType {
  std::string_view tag;
  void (*read)(SceneBuilder&, pugi::xml_node);
};

// bsdf and texture are read where they are used; default is part of the XML document.
constexpr std::array part_types = {
    PartType{"integrator", read_integrator},
    PartType{"sensor", read_sensor},
    PartType{"shape", read_shape},
    PartType{"emitter", read_scene_light},
    PartType{"bsdf", skip},
    PartType{"texture", skip},
    PartType{"default", skip},
    PartType{"sampler", skip},
};

}  // namespace

Scene load_scene(const std::filesystem::path& path, const SceneParameters& parameters,
                 std::stop_token stop) {
  SceneBuilder builder(path, parameters, stop);
  Scene& scene = builder.scene;
  scene.path = path;
  scene.name = printable(path.stem().string());
  const pugi::xml_node root = builder.xml.root();
  bool has_camera = false;
  for (pugi::xml_node part : root.children()) {
    check_cancelled(stop);
    if (part.type() != pugi::node_element) continue;
    const std::string_view tag = part.name();
    const auto* const type =
        std::find_if(part_types.begin(), part_types.end(),
                     [&](const PartType& candidate) { return candidate.tag == tag; });
    if (type == part_types.end()) {
      builder.warn(part, fmt::format("<{}> is not known and left out", excerpt(tag)));
      continue;
    }
    if (tag == "sensor" && std::exchange(has_camera, true)) {
      builder.warn(part, "a second sensor is left out: the first one counts");
      continue;
    }
    type->read(builder, part);
  }
  if (!has_camera) builder.xml.fail(root, "no camera, expected <sensor type=\"perspective\">");
  const bool lit = shines(scene.environment) || !scene.delta_lights.empty() ||
                   std::any_of(scene.shapes.begin(), scene.shapes.end(),
                               [](const Shape& shape) { return shape.emits; });
  if (!lit) {
    builder.xml.fail(
        root,
        "no light, expected an <emitter type=\"area\"> in a shape, or an <emitter> of type "
        "\"constant\" or \"point\"");
  }
  warn_of_dim_lights(builder);
  return std::move(scene);
}

}  // namespace quartet
