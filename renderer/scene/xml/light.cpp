#include "renderer/scene/xml/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/constants.hpp>
#include <string_view>

#include "renderer/base/image.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/mesh/mesh.h"
#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/element.h"

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
  builder.points.push_back(element.node());
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

void warn_of_dim_points(SceneBuilder& builder) {
  // Below this share of the power a light is chosen by fewer than one in 65536 samples. That of an
  // environment depends on the extent of all shapes and is left out.
  constexpr double least_share = 0x1p-16;
  const Scene& scene = builder.scene;
  const auto power = [](const PointLight& light) {
    return 4.0 * glm::pi<double>() * double(luminance(light.intensity));
  };
  double total = 0.0;
  for (const PointLight& light : scene.points) {
    total += power(light);
  }
  for (const Shape& shape : scene.shapes) {
    if (shape.emits) {
      total +=
          glm::pi<double>() * surface_area(shape) * double(largest_value(scene, shape.radiance));
    }
  }
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const double share = power(scene.points[i]) / total;
    if (share < least_share) {
      builder.warn(builder.points[i],
                   fmt::format("a point light with {:.2g} of the power of all lights: few samples "
                               "choose it, and what it alone lights will be noisy",
                               share));
    }
  }
}

}  // namespace quartet
