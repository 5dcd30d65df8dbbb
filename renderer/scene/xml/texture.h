#pragma once

#include <glm/glm.hpp>
#include <pugixml.hpp>

#include "renderer/scene/xml/element.h"

namespace quartet {

/// A <texture>, added to the scene's textures on its first use. A type that is not known becomes
/// grey 0.5 with a warning. Throws SceneError.
Color read_texture(SceneBuilder& builder, pugi::xml_node node);

/// The transform `to_uv` of a texture, as it acts on (u, v, 1). Throws SceneError.
glm::mat3 read_uv_transform(Element& element);

}  // namespace quartet
