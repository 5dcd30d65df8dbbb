#pragma once

#include <pugixml.hpp>

#include "renderer/scene/xml/scene_builder.h"

namespace quartet {

/// A <texture>, added to the scene's textures on its first use. A type that is not known becomes
/// grey 0.5 with a warning. Throws SceneError.
Color read_texture(SceneBuilder& builder, pugi::xml_node node);

}  // namespace quartet
