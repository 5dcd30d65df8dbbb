#include "renderer/scene/obj_file.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>

#include "renderer/scene/number.h"

namespace quartet {
namespace {

/// tinyobjloader reads "nan", "1,5" and missing coordinates as 0, so they are looked for before.
void check_numbers(const std::filesystem::path& path, std::string_view text) {
  int line_number = 0;
  while (!text.empty()) {
    ++line_number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line = line.substr(0, line.find('#'));
    if (line.empty() || line[0] != 'v') continue;
    const auto parts = split(line);
    const std::size_t needed = parts[0] == "v" || parts[0] == "vn" ? 3 : parts[0] == "vt" ? 2 : 0;
    if (needed == 0) continue;
    if (parts.size() <= needed) {
      throw std::runtime_error(fmt::format("{}:{}: '{}' has {} numbers, expected {}", path.string(),
                                           line_number, parts[0], parts.size() - 1, needed));
    }
    for (std::size_t i = 1; i <= needed; ++i) {
      if (!parse_number(parts[i])) {
        throw std::runtime_error(fmt::format("{}:{}: '{}' is not a finite number", path.string(),
                                             line_number, parts[i]));
      }
    }
  }
}

}  // namespace

Mesh read_obj(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error(fmt::format("cannot read the mesh file {}", path.string()));
  }
  check_numbers(path, text);

  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning;
  std::string error;
  std::istringstream stream(text);
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream)) {
    std::replace(error.begin(), error.end(), '\n', ' ');
    throw std::runtime_error(fmt::format("{}: {}", path.string(), error));
  }

  const auto row = [&](int index, std::size_t width, std::size_t size, std::string_view what) {
    if (index < 0 || (std::size_t(index) + 1) * width > size) {
      throw std::runtime_error(fmt::format("{}: a face uses {} {}, the file has {}", path.string(),
                                           what, index + 1, size / width));
    }
    return std::size_t(index) * width;
  };
  Mesh mesh;
  bool has_uvs = true;
  bool has_normals = true;
  std::map<std::tuple<int, int, int>, unsigned> vertices;
  const auto vertex = [&](const tinyobj::index_t& index) {
    const auto [entry, is_new] =
        vertices.try_emplace({index.vertex_index, index.texcoord_index, index.normal_index},
                             unsigned(mesh.positions.size()));
    if (!is_new) return entry->second;
    const auto& v = attributes.vertices;
    const auto& t = attributes.texcoords;
    const auto& n = attributes.normals;
    const std::size_t p = row(index.vertex_index, 3, v.size(), "vertex");
    mesh.positions.emplace_back(v[p], v[p + 1], v[p + 2]);
    has_uvs = has_uvs && index.texcoord_index >= 0;
    has_normals = has_normals && index.normal_index >= 0;
    if (has_uvs) {
      const std::size_t i = row(index.texcoord_index, 2, t.size(), "uv");
      mesh.uvs.emplace_back(t[i], t[i + 1]);
    }
    if (has_normals) {
      const std::size_t i = row(index.normal_index, 3, n.size(), "normal");
      mesh.normals.emplace_back(n[i], n[i + 1], n[i + 2]);
    }
    return entry->second;
  };
  for (const tinyobj::shape_t& shape : shapes) {
    const auto& indices = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      const unsigned a = vertex(indices[i]);
      const unsigned b = vertex(indices[i + 1]);
      const unsigned c = vertex(indices[i + 2]);
      mesh.triangles.emplace_back(a, b, c);
    }
  }
  if (!has_uvs) mesh.uvs.clear();
  if (!has_normals) mesh.normals.clear();
  return mesh;
}

}  // namespace quartet
