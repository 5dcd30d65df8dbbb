#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace quartet {

/// A hash of what is rendered, as 16 hexadecimal digits: shapes, materials, textures and light. Two
/// files that say the same in other words have the same hash. Left out is what is a setting of a
/// run (camera, size, depth) and what has no influence on the picture (names, lines, warnings).
std::string scene_hash(const Scene& scene);

}  // namespace quartet
