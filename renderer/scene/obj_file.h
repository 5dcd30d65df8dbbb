#pragma once

#include <filesystem>

#include "renderer/scene/scene.h"

namespace quartet {

/// A Wavefront OBJ file as it stands there: polygons cut into triangles, one vertex for each
/// combination of position, uv and normal that a face uses; normals or uvs are empty unless every
/// face vertex has one. Throws std::runtime_error "file:line: message" or "file: message".
Mesh read_obj(const std::filesystem::path& path);

}  // namespace quartet
