#include "renderer/scene/textures/checkerboard.h"

#include "renderer/scene/hasher.h"
#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/element.h"
#include "renderer/scene/xml/element_writer.h"
#include "renderer/scene/xml/texture.h"

namespace quartet {

void Checkerboard::add_to(Hasher& hasher) const {
  const auto& [first, second, transform] = *this;
  hasher.add_all(first, second, transform);
}

Checkerboard Checkerboard::read(SceneBuilder& builder, Element& element) {
  Checkerboard board;
  board.color0 = read_plain_color(builder, element, "color0", board.color0, ColorRange::any);
  board.color1 = read_plain_color(builder, element, "color1", board.color1, ColorRange::any);
  board.to_uv = read_uv_transform(element);
  return board;
}

void Checkerboard::write(ElementWriter& element) const {
  element.color("color0", color0);
  element.color("color1", color1);
  element.transform("to_uv", to_uv);
}

}  // namespace quartet
