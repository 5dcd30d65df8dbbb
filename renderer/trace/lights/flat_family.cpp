#include <cmath>

#include "renderer/base/math/warp.h"
#include "renderer/trace/lights/light.h"

// Parallelograms, triangles and disks.

namespace quartet {
namespace {

/// The radiance at a place along the edges of a light.
glm::vec3 radiance_on_edges(const Light& light, const Scene& scene, glm::vec3 position,
                            glm::vec2 on_edges) {
  Hit hit{};
  hit.primitive = light.primitive;
  hit.u = on_edges.x;
  hit.v = on_edges.y;
  if (light.domain == LightDomain::square) {
    // Its triangles (0,1,2) and (0,2,3), with the barycentrics of their last two corners.
    hit.primitive = on_edges.x >= on_edges.y ? 0 : 1;
    hit.u = hit.primitive == 0 ? on_edges.x - on_edges.y : on_edges.x;
    hit.v = hit.primitive == 0 ? on_edges.y : on_edges.y - on_edges.x;
  }
  return radiance_at(light, scene, position, hit);
}

LightSample sample_flat(const Light& light, const Scene& scene, glm::vec3 from, float u, float v) {
  LightSample s{};
  const LightRow& row = light.row;
  glm::vec2 p(u, v);
  if (light.domain == LightDomain::triangle) {
    p = square_to_triangle(u, v);
  } else if (light.domain == LightDomain::disk) {
    p = square_to_disk(u, v);
  }
  const glm::vec3 to_light = row.origin + p.x * row.edge1 + p.y * row.edge2 - from;
  const float distance2 = glm::dot(to_light, to_light);
  const float facing = -glm::dot(to_light, row.normal);
  if (!(facing > 0.0f)) {
    return s;
  }
  const float distance = std::sqrt(distance2);
  s.direction = to_light * (1.0f / distance);
  s.distance = distance * short_of_light;
  s.radiance = light.textured ? radiance_on_edges(light, scene, from + to_light, p) : row.radiance;
  s.pdf = distance2 * distance * row.density / facing;
  return s;
}

float flat_pdf(const Light& light, const Surface& surface, glm::vec3 /*from*/, glm::vec3 direction,
               float distance) {
  return area_pdf(light, surface, direction, distance);
}

constexpr LightFamily flat_family{sample_flat, flat_pdf, area_power};

}  // namespace

void add_lights(const Mesh& mesh, std::uint32_t shape, std::vector<Light>& lights) {
  const auto add = [&](LightDomain domain, glm::uvec3 corners, std::uint32_t primitive) {
    Light light{.family = &flat_family, .domain = domain, .shape = shape, .primitive = primitive};
    LightRow& row = light.row;
    row.origin = mesh.positions[corners.x];
    row.edge1 = mesh.positions[corners.y] - row.origin;
    row.edge2 = mesh.positions[corners.z] - row.origin;
    row.normal = unit_cross(row.edge1, row.edge2);
    light.area = glm::length(glm::cross(row.edge1, row.edge2));
    if (light.area < 1e-15f) {  // its square left the range of float
      light.area = float(glm::length(glm::cross(glm::dvec3(row.edge1), glm::dvec3(row.edge2))));
    }
    light.area *= domain == LightDomain::triangle ? 0.5f : 1.0f;
    lights.push_back(light);
  };
  if (mesh.parallelogram) {
    add(LightDomain::square, {0, 1, 3}, 0);
    return;
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    add(LightDomain::triangle, mesh.triangles[i], std::uint32_t(i));
  }
}

void add_lights(const Disk& disk, std::uint32_t shape, std::vector<Light>& lights) {
  lights.push_back({.row = {.origin = disk.center,
                            .edge1 = disk.radius * disk.axis_u,
                            .edge2 = disk.radius * disk.axis_v,
                            .normal = disk.normal},
                    .family = &flat_family,
                    .domain = LightDomain::disk,
                    .radius = disk.radius,
                    .area = pi * disk.radius * disk.radius,
                    .shape = shape});
}

}  // namespace quartet
