#include "renderer/scene/lights/point_light.h"

#include <fmt/format.h>

#include <glm/gtc/constants.hpp>

#include "renderer/base/image.h"
#include "renderer/base/number_text.h"
#include "renderer/scene/hasher.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/element.h"
#include "renderer/scene/xml/element_writer.h"

namespace quartet {

double PointLight::power() const {
  return 4.0 * glm::pi<double>() * double(luminance(intensity));
}

std::string PointLight::text() const {
  return fmt::format("at {}, intensity {}", vector_text(position), vector_text(intensity));
}

void PointLight::add_to(Hasher& hasher) const {
  const auto& [place, strength] = *this;
  hasher.add_all(place, strength);
}

PointLight PointLight::read(SceneBuilder& builder, Element& element) {
  PointLight light;
  light.intensity =
      read_plain_color(builder, element, "intensity", glm::vec3(1.0f), ColorRange::intensity);
  if (element.has("position") && element.has("to_world")) {
    element.fail("a light with position and to_world, expected one of them");
  }
  light.position = element.has("to_world") ? glm::vec3(element.transform("to_world")[3])
                                           : glm::vec3(element.point("position", glm::dvec3(0.0)));
  if (!light.shines()) {
    element.warn("a light with intensity 0 is left out");
  } else if (const std::string fault = position_fault(light.position); !fault.empty()) {
    element.fail(fmt::format("{}: {}", element.title(), fault));
  }
  return light;
}

void PointLight::write(ElementWriter& element) const {
  element.point("position", position);
  element.color("intensity", intensity);
}

}  // namespace quartet
