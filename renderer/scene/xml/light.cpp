#include "renderer/scene/xml/light.h"

#include <fmt/format.h>

#include <glm/gtc/constants.hpp>
#include <optional>
#include <string_view>

#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/read_kind.h"

namespace quartet {
namespace {

void read_area_light(SceneBuilder& builder, Element& element, Shape& shape) {
  shape.radiance = read_color(builder, element, "radiance", glm::vec3(1.0f), ColorRange::radiance);
  shape.emits = largest_value(builder.scene.textures, shape.radiance) > 0.0f;
  if (!shape.emits) element.warn("a light with radiance 0 is left out");
}

void add_delta_light(SceneBuilder& builder, const Element& element, const DeltaLight& light) {
  if (!std::visit([](const auto& kind) { return kind.shines(); }, light)) return;
  builder.count_lights(element.node(), 1);
  builder.scene.delta_lights.push_back(light);
  builder.delta_lights.push_back(element.node());
}

void set_environment(SceneBuilder& builder, const Element& element,
                     const Environment& environment) {
  if (shines(builder.scene.environment)) {
    element.fail("a second light from all around the scene, expected at most one");
  }
  builder.scene.environment = environment;
}

void warn_unused_of_light(Element& element) {
  element.ignore({"sampling_weight"});
  element.warn_unused();
}

void warn_unknown_light(Element& element, std::string_view place) {
  element.warn(fmt::format("{} is not known {} and left out", element.title(), place));
}

}  // namespace

void read_shape_light(SceneBuilder& builder, pugi::xml_node node, Shape& shape) {
  Element element(builder, node);
  if (element.type() != "area") return warn_unknown_light(element, "in a shape");
  read_area_light(builder, element, shape);
  warn_unused_of_light(element);
}

void read_scene_light(SceneBuilder& builder, pugi::xml_node node) {
  Element element(builder, node);
  if (std::optional<DeltaLight> light = read_kind<DeltaLight>(builder, element)) {
    add_delta_light(builder, element, *light);
  } else if (std::optional<Environment> around = read_kind<Environment>(builder, element)) {
    set_environment(builder, element, *around);
  } else {
    return warn_unknown_light(element, "outside a shape");
  }
  warn_unused_of_light(element);
}

void warn_of_dim_lights(SceneBuilder& builder) {
  // Below this share of the power a light is chosen by fewer than one in 65536 samples. That of an
  // environment depends on the extent of all shapes and is left out.
  constexpr double least_share = 0x1p-16;
  const Scene& scene = builder.scene;
  const auto power_of = [](const DeltaLight& light) {
    return std::visit([](const auto& kind) { return kind.power(); }, light);
  };
  double total = 0.0;
  for (const DeltaLight& light : scene.delta_lights) {
    total += power_of(light);
  }
  for (const Shape& shape : scene.shapes) {
    if (shape.emits) {
      total += glm::pi<double>() * surface_area(shape) *
               double(largest_value(scene.textures, shape.radiance));
    }
  }
  for (std::size_t i = 0; i < scene.delta_lights.size(); ++i) {
    const double share = power_of(scene.delta_lights[i]) / total;
    if (share < least_share) {
      const std::string_view name = std::visit(
          []<class Kind>(const Kind& /*kind*/) { return Kind::name; }, scene.delta_lights[i]);
      builder.warn(builder.delta_lights[i],
                   fmt::format("a {} light with {:.2g} of the power of all lights: few samples "
                               "choose it, and what it alone lights will be noisy",
                               name, share));
    }
  }
}

}  // namespace quartet
