#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "renderer/scene/mesh/mesh.h"

namespace quartet {

struct ObjFile {
  Mesh mesh;
  /// What was left out or cut as it came, each without the file's name.
  std::vector<std::string> warnings;
};

/// A Wavefront OBJ file as it stands there: polygons cut into triangles, convex or not, one vertex
/// for each combination of position, uv and normal that a face uses; normals or uvs are empty
/// unless every face vertex has one. Materials, groups and names mean nothing here; lines, points
/// and curved surfaces are left out with a warning. Every number and index is checked, whether it
/// is used or not. Throws std::runtime_error "file:line: message" or "cannot read file: message",
/// and Cancelled once `stop` is asked for.
ObjFile read_obj(const std::filesystem::path& path, const std::stop_token& stop = {});

}  // namespace quartet
