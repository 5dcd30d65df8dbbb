#include "renderer/scene/lights/constant_environment.h"

#include <fmt/format.h>

#include "renderer/base/number_text.h"
#include "renderer/scene/hasher.h"
#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/element.h"
#include "renderer/scene/xml/element_writer.h"

namespace quartet {

std::string ConstantEnvironment::text() const {
  return fmt::format("from all around, radiance {}", vector_text(radiance));
}

void ConstantEnvironment::add_to(Hasher& hasher) const {
  const auto& [everywhere] = *this;
  hasher.add(everywhere);
}

ConstantEnvironment ConstantEnvironment::read(SceneBuilder& builder, Element& element) {
  const ConstantEnvironment environment{
      read_plain_color(builder, element, "radiance", glm::vec3(1.0f), ColorRange::radiance)};
  if (!environment.shines()) element.warn("a light with radiance 0 is left out");
  element.ignore({"to_world"});  // the same from every direction
  return environment;
}

void ConstantEnvironment::write(ElementWriter& element) const {
  element.color("radiance", radiance);
}

}  // namespace quartet
