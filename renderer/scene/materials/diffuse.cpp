#include "renderer/scene/materials/diffuse.h"

#include <fmt/format.h>

#include "renderer/scene/materials/hashed_row.h"
#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/element_writer.h"

namespace quartet {

std::string Diffuse::text(const Textures& textures) const {
  return fmt::format("reflectance {}", color_text(textures, reflectance));
}

void Diffuse::add_to(Hasher& hasher) const {
  const auto& [albedo] = *this;
  hasher.add(HashedRow{.reflectance = albedo});
}

Diffuse Diffuse::read(SceneBuilder& builder, Element& element) {
  return {read_color(builder, element, "reflectance", glm::vec3(0.5f), ColorRange::reflectance)};
}

void Diffuse::write(ElementWriter& element) const {
  element.color("reflectance", reflectance);
}

}  // namespace quartet
