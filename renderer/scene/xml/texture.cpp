#include "renderer/scene/xml/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "renderer/scene/limits.h"
#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/element.h"

namespace quartet {
namespace {

/// The part of a transform that acts on uv. A 3 × 3 <matrix> holds its translation in the third
/// column, the other operations in the fourth, so both count.
glm::mat3 uv_transform(const glm::dmat4& m) {
  return glm::mat3(glm::dmat3(m[0][0], m[0][1], 0.0,  //
                              m[1][0], m[1][1], 0.0,  //
                              m[2][0] + m[3][0], m[2][1] + m[3][1], 1.0));
}

Color checkerboard(SceneBuilder& builder, Element& element) {
  Checkerboard board;
  board.color0 = read_plain_color(builder, element, "color0", board.color0, ColorRange::any);
  board.color1 = read_plain_color(builder, element, "color1", board.color1, ColorRange::any);
  board.to_uv = uv_transform(element.transform("to_uv"));
  for (int column = 0; column < 3; ++column) {
    const glm::vec3 size = glm::abs(board.to_uv[column]);
    if (!glm::all(glm::lessThanEqual(size, glm::vec3(float(largest_uv_factor))))) {
      element.fail(fmt::format("to_uv of {} has an entry of {}, at most {} is possible",
                               element.title(), std::max({size.x, size.y, size.z}),
                               largest_uv_factor));
    }
  }
  builder.scene.textures.push_back(board);
  return {glm::vec3(0.0f), int(builder.scene.textures.size()) - 1};
}

struct TextureType {
  std::string_view name;
  Color (*read)(SceneBuilder&, Element&);
};

constexpr std::array texture_types = {TextureType{"checkerboard", checkerboard}};

}  // namespace

Color read_texture(SceneBuilder& builder, pugi::xml_node node) {
  const auto known = builder.textures.find(node);
  if (known != builder.textures.end()) return {glm::vec3(0.0f), known->second};
  const OpenElement open(builder, node);
  Element element(builder, node);
  const auto* const type =
      std::find_if(texture_types.begin(), texture_types.end(),
                   [&](const TextureType& candidate) { return candidate.name == element.type(); });
  if (type == texture_types.end()) {
    element.warn(fmt::format("{} is not known and becomes grey 0.5", element.title()));
    return {glm::vec3(0.5f)};
  }
  const Color color = type->read(builder, element);
  element.warn_unused();
  builder.textures[node] = color.texture;
  return color;
}

}  // namespace quartet
