#pragma once

#include "renderer/base/math/warp.h"
#include "renderer/trace/lights/light.h"

namespace quartet {

/// The same in all lanes.
inline LightRow8 splat(const LightRow& row) {
  return {splat(row.origin), splat(row.edge1),    splat(row.edge2),
          splat(row.normal), splat(row.radiance), splat(row.density)};
}

inline LightRow8 gather(const LightRow* const (&rows)[simd_lanes]) {
  Columns columns(rows);
  return {columns.vector(), columns.vector(), columns.vector(),
          columns.vector(), columns.vector(), columns.number()};
}

/// What the families sample of eight lights, each from a point of its own, where none of them is
/// textured or sampled alone. `domains` holds a LightDomain a lane.
inline LightSample8 sample_rows(const LightRow8& row, Int8 domains, Float8 probability,
                                const Vec8& from, Float8 u, Float8 v) {
  LightSample8 s;
  s.is_point = domains == int(LightDomain::point);
  const Mask8 triangle = domains == int(LightDomain::triangle);
  const Mask8 disk = domains == int(LightDomain::disk);
  Vec2x8 p{u, v};
  if (any(triangle)) {
    const Vec2x8 q = square_to_triangle(u, v);
    p = {triangle ? q.x : p.x, triangle ? q.y : p.y};
  }
  if (any(disk)) {
    const Vec2x8 q = square_to_disk(u, v);
    p = {disk ? q.x : p.x, disk ? q.y : p.y};
  }
  const Vec8 edges = row.origin + p.x * row.edge1 + p.y * row.edge2;
  const Vec8 to_light = select(s.is_point, row.origin, edges) - from;
  const Float8 distance2 = dot(to_light, to_light);
  const Float8 facing = -dot(to_light, row.normal);
  const Float8 distance = sqrt(distance2);
  s.direction = to_light * (1.0f / distance);
  s.distance = s.is_point ? distance : distance * short_of_light;
  s.radiance = select(facing > 0.0f, row.radiance, Vec8{});
  s.radiance = select(s.is_point, row.radiance * (1.0f / distance2), s.radiance);
  s.pdf = s.is_point ? probability : distance2 * distance * row.density / facing;
  return s;
}

}  // namespace quartet
