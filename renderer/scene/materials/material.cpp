#include "renderer/scene/materials/material.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/scene/hasher.h"

namespace quartet {

void Material::add_to(Hasher& hasher) const {
  const auto& [of_kind, both_sides, name] = *this;
  hasher.add_all(int(of_kind.index()), both_sides);
  std::visit([&](const auto& each) { hasher.add(each); }, of_kind);
}

std::string_view material_name(const Material& material) {
  return std::visit([]<class Kind>(const Kind& /*kind*/) { return Kind::name; }, material.kind);
}

std::string material_text(const Textures& textures, const Material& material) {
  return fmt::format(
      "{}, {}{}", material_name(material),
      std::visit([&](const auto& kind) { return kind.text(textures); }, material.kind),
      material.two_sided ? ", two-sided" : "");
}

bool is_textured(const Material& material) {
  return std::visit(
      [](const auto& kind) {
        const auto colors = kind.colors();
        return std::any_of(colors.begin(), colors.end(),
                           [](const Color& color) { return color.is_textured(); });
      },
      material.kind);
}

bool transmits(const Material& material) {
  return std::visit([]<class Kind>(const Kind& /*kind*/) { return Kind::AtPoint::transmits; },
                    material.kind);
}

}  // namespace quartet
