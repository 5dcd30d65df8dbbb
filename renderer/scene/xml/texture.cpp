#include "renderer/scene/xml/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "renderer/scene/limits.h"
#include "renderer/scene/xml/read_kind.h"

namespace quartet {

Color read_texture(SceneBuilder& builder, pugi::xml_node node) {
  const auto known = builder.textures.find(node);
  if (known != builder.textures.end()) return {glm::vec3(0.0f), known->second};
  const OpenElement open(builder, node);
  Element element(builder, node);
  std::optional<Texture> texture = read_kind<Texture>(builder, element);
  if (!texture) {
    element.warn(fmt::format("{} is not known and becomes grey 0.5", element.title()));
    return {glm::vec3(0.5f)};
  }
  element.warn_unused();
  const int index = int(builder.scene.textures.size());
  builder.scene.textures.push_back(*texture);
  builder.textures[node] = index;
  return {glm::vec3(0.0f), index};
}

glm::mat3 read_uv_transform(Element& element) {
  // A 3 × 3 <matrix> holds its translation in the third column, the other operations in the fourth,
  // so both count.
  const glm::dmat4 m = element.transform("to_uv");
  const glm::mat3 to_uv(glm::dmat3(m[0][0], m[0][1], 0.0,  //
                                   m[1][0], m[1][1], 0.0,  //
                                   m[2][0] + m[3][0], m[2][1] + m[3][1], 1.0));
  for (int column = 0; column < 3; ++column) {
    const glm::vec3 size = glm::abs(to_uv[column]);
    if (!glm::all(glm::lessThanEqual(size, glm::vec3(float(largest_uv_factor))))) {
      element.fail(fmt::format("to_uv of {} has an entry of {}, at most {} is possible",
                               element.title(), std::max({size.x, size.y, size.z}),
                               largest_uv_factor));
    }
  }
  return to_uv;
}

}  // namespace quartet
