#pragma once

#include <glm/glm.hpp>
#include <span>
#include <stop_token>
#include <vector>

namespace quartet {

/// How a polygon could be cut.
enum class PolygonCut {
  whole,     ///< its triangles cover its inside once
  crossing,  ///< it crosses itself or encloses nothing, so that some triangles are cut as they come
  too_many,  ///< it is not convex and has more than most_concave_corners: nothing was done
};

inline constexpr std::size_t most_concave_corners = 100'000;

/// Cuts a polygon of three corners or more, convex or not, into triangles of its corners' numbers,
/// appended to `triangles`; they keep its direction. It is looked at along its mean normal (Newell
/// 1972; Sutherland, Sproull and Schumacker 1974), so it need not be flat. Throws Cancelled.
///
/// Ears are clipped: Meisters, "Polygons Have Ears", American Mathematical Monthly 82(6), 1975;
/// Eberly, "Triangulation by Ear Clipping", 1998. A corner that touches the border of a triangle
/// from within stands in its way as well: else right-angled shapes would be walled up.
PolygonCut cut_polygon(std::span<const glm::vec3> corners, std::vector<glm::uvec3>& triangles,
                       const std::stop_token& stop = {});

}  // namespace quartet
