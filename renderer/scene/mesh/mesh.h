#pragma once

#include <glm/glm.hpp>
#include <stop_token>

#include "renderer/scene/scene.h"

namespace quartet {

// What takes long for a large mesh throws Cancelled soon after `stop` was asked for; the mesh is of
// no use then.

/// Mitsuba's rectangle: [-1, 1]² at z = 0 with normal +z and uv [0, 1]², placed by `to_world`.
Mesh make_rectangle(const glm::dmat4& to_world, bool flip_normals);

/// Mitsuba's cube: [-1, 1]³, each face with uv [0, 1]², placed by `to_world`.
Mesh make_cube(const glm::dmat4& to_world, bool face_normals, bool flip_normals);

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

/// Total area of a shape.
double surface_area(const Shape& shape);

}  // namespace quartet
