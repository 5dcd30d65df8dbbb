#include "renderer/scene/materials/conductor.h"

#include "renderer/scene/materials/hashed_row.h"
#include "renderer/scene/xml/element_writer.h"

namespace quartet {

void Conductor::add_to(Hasher& hasher) const {
  const auto& [reflectance, eta, k] = metal;
  hasher.add(HashedRow{.reflectance = reflectance, .eta = eta, .k = k});
}

Conductor Conductor::read(SceneBuilder& builder, Element& element) {
  return {Metal::read(builder, element)};
}

void Conductor::write(ElementWriter& element) const {
  metal.write(element);
}

}  // namespace quartet
