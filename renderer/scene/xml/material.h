#pragma once

#include <pugixml.hpp>

#include "renderer/scene/xml/scene_builder.h"

namespace quartet {

/// A <bsdf>, added to the scene's materials on its first use; returns its index. A type that is not
/// known becomes diffuse 0.5 with a warning. Throws SceneError.
int read_material(SceneBuilder& builder, pugi::xml_node node);

/// What a shape without a bsdf gets, as in Mitsuba: diffuse 0.5. Returns its index.
int default_material(SceneBuilder& builder);

}  // namespace quartet
