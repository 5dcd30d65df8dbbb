#include "renderer/scene/materials/dielectric.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/base/excerpt.h"
#include "renderer/base/lower_case.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/materials/hashed_row.h"
#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/element_writer.h"
#include "renderer/scene/xml/refractive_index.h"

namespace quartet {
namespace {

void check_ior(const Element& element, std::string_view name, double ior) {
  if (!(ior >= least_ior && ior <= largest_ior)) {
    element.fail(fmt::format("{} of {} is {}, must be from {} to {}", name, element.title(), ior,
                             least_ior, largest_ior));
  }
}

double read_ior(SceneBuilder& builder, Element& element, std::string_view name,
                std::string_view fallback) {
  const pugi::xml_node node = element.property(name, {"float", "string"});
  if (node && std::string_view(node.name()) == "float") {
    const double ior = element.positive(name, 1.0);
    check_ior(element, name, ior);
    return ior;
  }
  const std::string wanted =
      lower_case(node ? node.attribute("value").value() : std::string(fallback));
  const auto table = named_dielectrics();
  const auto row = std::find_if(table.begin(), table.end(), [&](const NamedDielectric& candidate) {
    return candidate.name == wanted;
  });
  if (row == table.end()) {
    builder.xml.fail(node, fmt::format("{} is '{}', expected a number or one of {}", name,
                                       excerpt(wanted), names(table)));
  }
  return row->ior;
}

}  // namespace

std::string Dielectric::text(const Textures& textures) const {
  return fmt::format("reflectance {}, index {:.4g}", color_text(textures, reflectance), ior);
}

void Dielectric::add_to(Hasher& hasher) const {
  const auto& [reflected, transmitted, index] = *this;
  hasher.add(HashedRow{.reflectance = reflected, .transmittance = transmitted, .ior = index});
}

Dielectric Dielectric::read(SceneBuilder& builder, Element& element) {
  Dielectric material;
  const double ior =
      read_ior(builder, element, "int_ior", "bk7") / read_ior(builder, element, "ext_ior", "air");
  check_ior(element, "int_ior over ext_ior", ior);
  material.ior = float(ior);
  material.reflectance = read_color(builder, element, "specular_reflectance", glm::vec3(1.0f),
                                    ColorRange::reflectance);
  material.transmittance = read_color(builder, element, "specular_transmittance", glm::vec3(1.0f),
                                      ColorRange::reflectance);
  return material;
}

void Dielectric::write(ElementWriter& element) const {
  element.number("int_ior", ior);
  element.number("ext_ior", 1.0f);
  element.color("specular_reflectance", reflectance);
  element.color("specular_transmittance", transmittance);
}

}  // namespace quartet
