#pragma once

#include <pugixml.hpp>

#include "renderer/scene/xml/scene_builder.h"

namespace quartet {

/// A <shape>, added to the scene with its material and light. A type that is not known is left out
/// with a warning. Throws SceneError.
void read_shape(SceneBuilder& builder, pugi::xml_node node);

}  // namespace quartet
