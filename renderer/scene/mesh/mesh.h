#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/shapes/box.h"

namespace quartet {

class ElementWriter;
class Hasher;

/// Triangles; normals and uvs are either empty or one a vertex. The geometric normal of a triangle
/// follows the right-hand rule over its vertices and is the emitting, front side.
struct Mesh {
  static constexpr std::string_view name = "mesh";

  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;
  std::vector<glm::uvec3> triangles;
  /// The mesh is exactly one parallelogram: triangles (0,1,2) and (0,2,3), corner 0 and edges to 1
  /// and 3. Such a light is sampled as one piece rather than two.
  bool parallelogram = false;

  Box box() const;
  double area() const;
  std::size_t pieces() const { return triangles.size(); }
  std::string text() const;
  void add_to(Hasher& hasher) const;
  void write(ElementWriter& element) const;
};

// What takes long for a large mesh throws Cancelled soon after `stop` was asked for; the mesh is of
// no use then.

/// Moves positions by `to_world` and normals by its inverse transpose.
void transform(Mesh& mesh, const glm::dmat4& to_world, const std::stop_token& stop = {});

/// Turns each triangle so that its geometric normal agrees with its vertex normals, which say where
/// the front is. Does nothing without normals. This is what a mirroring to_world needs.
void orient_by_normals(Mesh& mesh, const std::stop_token& stop = {});

/// Turns all triangles, and the normals if there are any.
void flip(Mesh& mesh);

/// Vertex normals as means of the adjacent triangles' normals, weighted by their angles (Thürmer
/// and Wüthrich, Computing Vertex Normals from Polygonal Facets, 1998).
void compute_normals(Mesh& mesh, const std::stop_token& stop = {});

/// uv = barycentric coordinates, with vertices of its own for each triangle: what Mitsuba shows of
/// a texture on a mesh without uv.
void make_barycentric_uvs(Mesh& mesh, const std::stop_token& stop = {});

/// Removes triangles without area, or too small to have one in single precision; returns how many.
std::size_t drop_degenerate_triangles(Mesh& mesh, const std::stop_token& stop = {});

}  // namespace quartet
