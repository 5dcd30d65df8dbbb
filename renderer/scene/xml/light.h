#pragma once

#include <pugixml.hpp>

#include "renderer/scene/xml/scene_builder.h"

namespace quartet {

/// An <emitter> inside a shape. A type that is not known there is left out with a warning, as is a
/// light whose radiance is 0. Throws SceneError.
void read_shape_light(SceneBuilder& builder, pugi::xml_node node, Shape& shape);

/// An <emitter> of the scene itself; the same holds.
void read_scene_light(SceneBuilder& builder, pugi::xml_node node);

/// Warns about each light without extent that is so dim beside the scene's other lights that few
/// samples choose it: they are chosen by power, and no ray finds it by chance. Call it once all are
/// read.
void warn_of_dim_lights(SceneBuilder& builder);

}  // namespace quartet
