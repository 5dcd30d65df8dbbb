#include "renderer/scene/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "renderer/scene/color.h"
#include "renderer/scene/element.h"
#include "renderer/scene/limits.h"

namespace quartet {
namespace {

void area(SceneBuilder& builder, Element& element, Shape& shape) {
  shape.radiance = read_color(builder, element, "radiance", glm::vec3(1.0f), ColorRange::radiance);
  shape.emits = largest_value(builder.scene, shape.radiance) > 0.0f;
  if (!shape.emits) element.warn("a light with radiance 0 is left out");
}

void constant(SceneBuilder& builder, Element& element) {
  const glm::vec3 radiance =
      read_plain_color(builder, element, "radiance", glm::vec3(1.0f), ColorRange::radiance);
  if (builder.scene.environment != glm::vec3(0.0f)) {
    element.fail("a second light from all around the scene, expected at most one");
  }
  if (radiance == glm::vec3(0.0f)) element.warn("a light with radiance 0 is left out");
  builder.scene.environment = radiance;
  element.ignore({"to_world"});  // the same from every direction
}

void point(SceneBuilder& builder, Element& element) {
  PointLight light;
  light.intensity =
      read_plain_color(builder, element, "intensity", glm::vec3(1.0f), ColorRange::intensity);
  if (element.has("position") && element.has("to_world")) {
    element.fail("a light with position and to_world, expected one of them");
  }
  light.position = element.has("to_world") ? glm::vec3(element.transform("to_world")[3])
                                           : glm::vec3(element.point("position", glm::dvec3(0.0)));
  if (light.intensity == glm::vec3(0.0f)) {
    element.warn("a light with intensity 0 is left out");
    return;
  }
  if (const std::string fault = position_fault(light.position); !fault.empty()) {
    element.fail(fmt::format("{}: {}", element.title(), fault));
  }
  builder.count_lights(element.node(), 1);
  builder.scene.points.push_back(light);
}

template <typename... Arguments>
struct LightType {
  std::string_view name;
  void (*read)(SceneBuilder&, Element&, Arguments...);
};

constexpr std::array shape_lights = {LightType<Shape&>{"area", area}};
constexpr std::array scene_lights = {LightType<>{"constant", constant},
                                     LightType<>{"point", point}};

template <typename Table, typename... Arguments>
void read_light(SceneBuilder& builder, pugi::xml_node node, const Table& table,
                std::string_view place, Arguments&... arguments) {
  Element element(builder, node);
  const auto type = std::find_if(table.begin(), table.end(), [&](const auto& candidate) {
    return candidate.name == element.type();
  });
  if (type == table.end()) {
    element.warn(fmt::format("{} is not known {} and left out", element.title(), place));
    return;
  }
  type->read(builder, element, arguments...);
  element.ignore({"sampling_weight"});
  element.warn_unused();
}

}  // namespace

void read_shape_light(SceneBuilder& builder, pugi::xml_node node, Shape& shape) {
  read_light(builder, node, shape_lights, "in a shape", shape);
}

void read_scene_light(SceneBuilder& builder, pugi::xml_node node) {
  read_light(builder, node, scene_lights, "outside a shape");
}

}  // namespace quartet
