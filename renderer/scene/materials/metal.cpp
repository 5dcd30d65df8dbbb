#include "renderer/scene/materials/metal.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/base/excerpt.h"
#include "renderer/base/number_text.h"
#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/element_writer.h"
#include "renderer/scene/xml/refractive_index.h"

namespace quartet {

std::string Metal::text(const Textures& textures) const {
  return fmt::format("reflectance {}, eta {}, k {}", color_text(textures, reflectance),
                     vector_text(eta), vector_text(k));
}

Metal Metal::read(SceneBuilder& builder, Element& element) {
  const std::string name = element.text("material", "none");
  const auto table = named_conductors();
  const auto row = std::find_if(table.begin(), table.end(), [&](const NamedConductor& candidate) {
    return candidate.name == name;
  });
  if (row == table.end()) {
    builder.xml.fail(element.property("material", {"string"}),
                     fmt::format("no metal is named '{}' (known: {}); expected one of them, or eta "
                                 "and k",
                                 excerpt(name), names(table)));
  }
  if (name != "none" && (element.has("eta") || element.has("k"))) {
    element.fail(
        fmt::format("{} has both material and eta or k, expected one of them", element.title()));
  }
  Metal metal;
  metal.eta = read_plain_color(builder, element, "eta", row->eta, ColorRange::metal_index);
  metal.k = read_plain_color(builder, element, "k", row->k, ColorRange::metal_index);
  metal.reflectance = read_color(builder, element, "specular_reflectance", glm::vec3(1.0f),
                                 ColorRange::reflectance);
  return metal;
}

void Metal::write(ElementWriter& element) const {
  element.color("eta", eta);
  element.color("k", k);
  element.color("specular_reflectance", reflectance);
}

}  // namespace quartet
