#include <algorithm>
#include <cmath>
#include <variant>

#include "renderer/base/math/warp.h"
#include "renderer/trace/frame.h"
#include "renderer/trace/lights/light.h"

namespace quartet {
namespace {

/// Whether a sphere light is sampled over its whole area, because the point lies inside it or so
/// close to it that the cone of directions would lose its digits.
bool sampled_by_area(float distance2, float radius) {
  return distance2 <= radius * radius * 1.0002f;
}

/// 1 − cos of the half angle under which a sphere is seen, in a form that keeps its digits for
/// small angles.
float one_minus_cos_cap(float distance2, float radius) {
  const float sin2 = radius * radius / distance2;
  return sin2 < 1e-3f ? 0.5f * sin2 * (1.0f + 0.25f * sin2) : 1.0f - std::sqrt(1.0f - sin2);
}

LightSample sample_sphere(const Light& light, const Scene& scene, glm::vec3 from, float u,
                          float v) {
  LightSample s{};
  const Sphere& sphere = std::get<Sphere>(scene.shapes[light.shape].geometry);
  const glm::vec3 to_center = light.row.origin - from;
  const float distance2 = glm::dot(to_center, to_center);
  glm::vec3 outward;
  if (sampled_by_area(distance2, light.radius)) {
    outward = square_to_uniform_cap(u, v, -1.0f);
    const glm::vec3 to_light = to_center + light.radius * outward;
    const float length2 = glm::dot(to_light, to_light);
    const float length = std::sqrt(length2);
    s.direction = to_light / length;
    s.distance = length * short_of_light;
    const float cos_light = std::abs(glm::dot(s.direction, outward));
    if (!(cos_light > 0.0f)) {
      return s;  // along the surface, or no way at all
    }
    s.pdf = length2 / cos_light * light.row.density;
  } else {
    // Uniform over the cone of directions that meet the sphere: Shirley, Wang and Zimmerman, "Monte
    // Carlo Techniques for Direct Lighting Calculations", TOG 15(1), 1996.
    const float distance = std::sqrt(distance2);
    const float cap = one_minus_cos_cap(distance2, light.radius);
    const float one_minus_cos = u * cap;
    const float sin2 = one_minus_cos * (2.0f - one_minus_cos);
    const float sine = std::sqrt(sin2);
    const float phi = 2.0f * pi * v;
    const Frame frame(to_center / distance);
    s.direction =
        frame.to_world({sine * std::cos(phi), sine * std::sin(phi), 1.0f - one_minus_cos});
    const float half_chord2 = light.radius * light.radius - distance2 * sin2;
    const float near = distance * (1.0f - one_minus_cos) - std::sqrt(std::max(0.0f, half_chord2));
    outward = (near * s.direction - to_center) / light.radius;
    // At the silhouette `near` loses half its digits; what matters is that nothing but the light
    // itself lies in the part left out.
    s.distance = std::max(0.0f, near * short_of_light - 1e-3f * light.radius);
    s.pdf = light.probability / (2.0f * pi * cap);
  }
  const glm::vec3 front = sphere.flip_normals ? -outward : outward;
  if (glm::dot(s.direction, front) >= 0.0f) {
    return s;
  }
  s.radiance = radiance_at(light, scene, light.row.origin + light.radius * outward, {});
  return s;
}

float sphere_pdf(const Light& light, const Surface& surface, glm::vec3 from, glm::vec3 direction,
                 float distance) {
  const glm::vec3 to_center = light.row.origin - from;
  const float distance2 = glm::dot(to_center, to_center);
  if (!sampled_by_area(distance2, light.radius)) {
    return light.probability / (2.0f * pi * one_minus_cos_cap(distance2, light.radius));
  }
  return area_pdf(light, surface, direction, distance);
}

constexpr LightFamily sphere_family{sample_sphere, sphere_pdf, area_power};

}  // namespace

void add_lights(const Sphere& sphere, std::uint32_t shape, std::vector<Light>& lights) {
  lights.push_back({.row = {.origin = sphere.center},
                    .family = &sphere_family,
                    .radius = sphere.radius,
                    .area = 4.0f * pi * sphere.radius * sphere.radius,
                    .shape = shape});
}

}  // namespace quartet
