#pragma once

#include <pugixml.hpp>

#include "renderer/scene/xml/scene_builder.h"

namespace quartet {

/// A <sensor> with its <film>: the scene's camera, width and height. Throws SceneError.
void read_sensor(SceneBuilder& builder, pugi::xml_node node);

}  // namespace quartet
