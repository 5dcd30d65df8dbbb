#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "renderer/scene/xml/element.h"

namespace quartet {

/// What a colour slot holds, and thus what it may be: limits.h has the numbers. Negative values are
/// errors everywhere; a reflectance above 1 is warned about.
enum class ColorRange { any, reflectance, radiance, intensity, metal_index, alpha };

/// The property `name` as a colour: <rgb> (three numbers, one for grey, or sRGB-coded "#rrggbb"),
/// <spectrum>, <float>, or a texture, also through <ref>. `fallback` if absent. Throws SceneError.
Color read_color(SceneBuilder& builder, Element& element, std::string_view name,
                 const glm::vec3& fallback, ColorRange range);

/// The same where only one value can be used; a texture becomes its mean, with a warning.
glm::vec3 read_plain_color(SceneBuilder& builder, Element& element, std::string_view name,
                           const glm::vec3& fallback, ColorRange range);

}  // namespace quartet
