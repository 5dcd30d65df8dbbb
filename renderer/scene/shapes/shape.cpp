#include "renderer/scene/shapes/shape.h"

#include "renderer/scene/hasher.h"

namespace quartet {

void Shape::add_to(Hasher& hasher) const {
  const auto& [of_kind, of_material, shines, light, name, place] = *this;
  hasher.add(int(of_kind.index()));
  std::visit([&](const auto& kind) { hasher.add(kind); }, of_kind);
  hasher.add_all(of_material, shines, light);
}

double surface_area(const Shape& shape) {
  return std::visit([](const auto& kind) { return kind.area(); }, shape.geometry);
}

std::string_view shape_name(const Shape& shape) {
  return std::visit([]<class Kind>(const Kind& /*kind*/) { return Kind::name; }, shape.geometry);
}

std::string shape_text(const Shape& shape) {
  return std::visit([](const auto& kind) { return kind.text(); }, shape.geometry);
}

}  // namespace quartet
