#pragma once

#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

#include "renderer/scene/color.h"
#include "renderer/scene/textures/checkerboard.h"

namespace quartet {

/// The kinds of texture, one file each. A kind says what it is called in scene files (name), what
/// it shows at texture coordinates (at) and on average over the plane (mean), colours with the
/// smallest and the largest of each channel among them (extremes), what it is to people (text), and
/// how it is hashed (add_to), read (read) and written (write).
using Texture = std::variant<Checkerboard>;
using Textures = std::vector<Texture>;

/// The colour of a slot at a surface point with texture coordinates `uv`.
inline glm::vec3 color_at(const Textures& textures, const Color& color, glm::vec2 uv) {
  return color.is_textured() ? std::visit([&](const auto& kind) { return kind.at(uv); },
                                          textures[std::size_t(color.texture)])
                             : color.value;
}

/// The mean of a slot over the plane.
glm::vec3 average_color(const Textures& textures, const Color& color);

/// Largest of all that `color` can show, 0 for a colour that is black everywhere.
float largest_value(const Textures& textures, const Color& color);

/// "0.5", "0.1 0.2 0.3", "a checkerboard, 0.3 on average".
std::string color_text(const Textures& textures, const Color& color);

}  // namespace quartet
