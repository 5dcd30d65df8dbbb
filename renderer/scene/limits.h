#pragma once

#include <cstddef>
#include <string>

#include "renderer/scene/scene.h"

namespace quartet {

// The ranges within which a picture comes out right. Beyond them single precision loses what is
// asked for: products of four lengths leave the range of float, two corners fall on one point, or
// a ray is no ray to Embree. Each function says in words what is out of range and by how much, to
// stand behind a place ("file:line: "); nothing if all is well.

inline constexpr double largest_coordinate = 1e9;
/// Of a shape, from end to end.
inline constexpr double smallest_extent = 1e-10;
/// How far from the origin a shape may stand, in extents of its own: a closed room there loses half
/// a percent of its light, because rays start off its walls by what rounding may err; sixteen times
/// as far they start outside.
inline constexpr double farthest_in_extents = 65536.0;
inline constexpr float least_fov = 0.01f;  ///< degrees; two pixels would get the same ray
inline constexpr float largest_fov = 179.9f;
inline constexpr int largest_picture_side = 65536;
inline constexpr double largest_picture = 268435456.0;  ///< pixels
/// What the strongest channel of a light may be, unless it is 0.
inline constexpr double least_radiance = 1e-18;
inline constexpr double largest_radiance = 1e18;
inline constexpr double least_intensity = 1e-30;
inline constexpr double largest_intensity = 1e30;
/// A factor on light that is reflected or let through; above 1 it creates energy.
inline constexpr double largest_reflectance = 1000.0;
/// Real part and extinction of a metal.
inline constexpr double largest_metal_index = 1e4;
/// Of a glass on its own, and of inside over outside.
inline constexpr double least_ior = 0.01;
inline constexpr double largest_ior = 100.0;
inline constexpr double largest_alpha = 100.0;
/// Of the matrix that turns texture coordinates, entry by entry.
inline constexpr double largest_uv_factor = 1e6;
/// Of operands of a transform; what comes out of it has limits of its own.
inline constexpr double largest_operand = 1e30;
inline constexpr std::size_t most_shapes = 100'000;
/// Of all meshes together; they take about 200 bytes each.
inline constexpr std::size_t most_triangles = 50'000'000;
/// A triangle that shines counts as one. With random numbers of 24 bits, each must have a chance.
inline constexpr std::size_t most_lights = 1'048'576;

inline constexpr std::size_t most_warnings = 1000;

/// "origin is (1e+20, 0, 0), each coordinate must be from -1e+09 to 1e+09".
std::string camera_fault(const Camera& camera);

/// Of a picture in pixels.
std::string picture_size_fault(int width, int height);

/// Whether each coordinate is a number from -largest_coordinate to largest_coordinate.
bool is_position(const glm::vec3& p);

/// Of a place: a shape's or a light's.
std::string position_fault(const glm::vec3& position);

/// Of a shape's place and extent in the world.
std::string geometry_fault(const Shape& shape);

}  // namespace quartet
