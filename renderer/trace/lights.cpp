#include "renderer/trace/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "renderer/base/image.h"
#include "renderer/scene/limits.h"
#include "renderer/trace/color_at.h"
#include "renderer/base/warp.h"
#include "renderer/trace/frame.h"

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

/// The unit square onto barycentric coordinates. Folding the square keeps the stratification better
/// than the square root: Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
template <class F>
Vec2<F> square_to_triangle(F u, F v) {
  const auto upper = v > u;
  return {upper ? 0.5f * u : u - 0.5f * v, upper ? v - 0.5f * u : 0.5f * v};
}

constexpr double all_steps = 0x1p24;  // random numbers that there are

/// Where the random numbers of each light end, in steps of theirs, so that each probability is
/// exactly the share of numbers that choose its light. All but `floor` of each are dealt by share.
std::vector<std::uint32_t> dealt_steps(const std::vector<double>& shares, std::uint32_t floor) {
  std::vector<std::uint32_t> ends;
  const double rest = all_steps - double(floor) * double(shares.size());
  double sum = 0.0;
  for (const double share : shares) {
    sum += share;
    ends.push_back(std::uint32_t(std::round(sum * rest)) + floor * std::uint32_t(ends.size() + 1));
  }
  if (!ends.empty()) {
    ends.back() = std::uint32_t(all_steps);
  }
  return ends;
}

/// The same by power alone, unless a light is so dim that it would hardly be chosen: nothing else
/// finds a point light, and what is chosen once in a million samples is noise. Then each light gets
/// some numbers before the rest is dealt; all of these together are a small share.
std::vector<std::uint32_t> steps_by_share(const std::vector<double>& shares) {
  constexpr double most = 256.0;
  constexpr double most_together = 0x1p18;
  const auto floor = std::uint32_t(std::clamp(most_together / double(shares.size()), 1.0, most));
  std::vector<std::uint32_t> ends = dealt_steps(shares, 0);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i] - (i > 0 ? ends[i - 1] : 0) < floor) {
      return dealt_steps(shares, floor);
    }
  }
  return ends;
}

/// A bijection of the numbers in [0, 1) that the sampler gives: a number and what it is sent to are
/// the points of a lattice that fills the unit square evenly (Korobov, with the golden ratio).
float lattice_partner(float v) {
  return float((std::uint32_t(v * 0x1p24f) * 0x9e3779u) & 0xffffffu) * 0x1p-24f;
}

// A shadow ray stops short of the light by more than the rounding error of both ends.
constexpr float short_of_light = 1.0f - 1e-4f;

}  // namespace

Lights::Lights(const Scene& scene, glm::vec3 bounds_min, glm::vec3 bounds_max)
    : scene_(&scene), first_of_shape_(scene.shapes.size(), -1) {
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const Shape& shape = scene.shapes[i];
    if (shape.emits && luminance(average_color(scene, shape.radiance)) > 0.0f) {
      first_of_shape_[i] = int(lights_.size());
      std::visit([&](const auto& geometry) { add(std::uint32_t(i), geometry); }, shape.geometry);
    }
  }
  if (luminance(scene.environment) > 0.0f) {
    environment_ = int(lights_.size());
    lights_.push_back({.radiance = scene.environment, .kind = Kind::environment});
  }
  can_be_met_ = !lights_.empty();
  for (const PointLight& point : scene.points) {
    if (luminance(point.intensity) > 0.0f) {
      lights_.push_back(
          {.origin = point.position, .radiance = point.intensity, .kind = Kind::point});
    }
  }
  if (lights_.size() > most_lights) {
    throw std::runtime_error(
        fmt::format("{} lights, at most {} are possible", lights_.size(), most_lights));
  }
  choose_by_power(bounds_min, bounds_max);
}

void Lights::add(std::uint32_t shape_index, const Mesh& mesh) {
  const auto flat = [&](Kind kind, std::size_t a, std::size_t b, std::size_t c, std::uint32_t i) {
    Light light{.origin = mesh.positions[a], .kind = kind, .shape = shape_index, .primitive = i};
    light.edge1 = mesh.positions[b] - light.origin;
    light.edge2 = mesh.positions[c] - light.origin;
    light.normal = unit_cross(light.edge1, light.edge2);
    light.area = glm::length(glm::cross(light.edge1, light.edge2));
    if (light.area < 1e-15f) {  // its square left the range of float
      light.area = float(glm::length(glm::cross(glm::dvec3(light.edge1), glm::dvec3(light.edge2))));
    }
    light.area *= kind == Kind::triangle ? 0.5f : 1.0f;
    lights_.push_back(light);
  };
  if (mesh.parallelogram) {
    flat(Kind::parallelogram, 0, 1, 3, 0);
    return;
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    flat(Kind::triangle, t.x, t.y, t.z, std::uint32_t(i));
  }
}

void Lights::add(std::uint32_t shape_index, const Sphere& sphere) {
  lights_.push_back({.origin = sphere.center,
                     .kind = Kind::sphere,
                     .radius = sphere.radius,
                     .area = 4.0f * pi * sphere.radius * sphere.radius,
                     .shape = shape_index});
}

void Lights::add(std::uint32_t shape_index, const Disk& disk) {
  lights_.push_back({.origin = disk.center,
                     .edge1 = disk.radius * disk.axis_u,
                     .edge2 = disk.radius * disk.axis_v,
                     .normal = disk.normal,
                     .kind = Kind::disk,
                     .radius = disk.radius,
                     .area = pi * disk.radius * disk.radius,
                     .shape = shape_index});
}

void Lights::choose_by_power(glm::vec3 bounds_min, glm::vec3 bounds_max) {
  const float scene_radius = 0.5f * glm::length(bounds_max - bounds_min);
  std::vector<double> power;
  double total = 0.0;
  for (const Light& light : lights_) {
    // A flat or spherical light sends π A L, a point 4π I; the environment sends π R² L through the
    // scene from each of 4π directions.
    const double p =
        light.kind == Kind::environment
            ? 4.0 * pi * pi * scene_radius * scene_radius * luminance(scene_->environment)
        : light.kind == Kind::point
            ? 4.0 * pi * luminance(light.radiance)
            : pi * light.area *
                  luminance(average_color(*scene_, scene_->shapes[light.shape].radiance));
    power.push_back(p);
    total += p;
  }
  for (double& p : power) {
    // An environment around nothing has no power by this measure, yet must be found.
    p = total > 0.0 ? p / total : 1.0 / double(lights_.size());
  }
  const std::vector<std::uint32_t> ends = steps_by_share(power);
  float before = 0.0f;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const float until = float(ends[i]) * 0x1p-24f;
    Light& light = lights_[i];
    light.probability = until - before;
    if (light.kind != Kind::environment && light.kind != Kind::point) {
      const Color& radiance = scene_->shapes[light.shape].radiance;
      light.textured = radiance.texture != Color::no_texture;
      light.radiance = radiance.value;
      light.density = light.probability / light.area;
    }
    cdf_.push_back(until);
    before = until;
  }
}

/// The light of a number, and what is left of the number. What is left of few steps is few numbers,
/// and would sample the light in few places; `v`, which chooses the point with it, fills them up.
Lights::Choice Lights::choose(float u, float v) const {
  if (lights_.size() == 1) {
    return {lights_.data(), u};
  }
  const auto chosen = std::size_t(std::upper_bound(cdf_.begin(), cdf_.end() - 1, u) - cdf_.begin());
  // What is left of u within the light's interval is uniform again, and as well stratified. A
  // number stands for its whole step: a light of few steps would else be sampled off its centre.
  const float below = chosen > 0 ? cdf_[chosen - 1] : 0.0f;
  const float width = cdf_[chosen] - below;
  constexpr float few_steps = 0x1p-16f;
  const float in_step = width <= few_steps ? 0x1p-24f * lattice_partner(v) : 0x1p-25f;
  return {&lights_[chosen], std::clamp((u - below + in_step) / width, 0.0f, 0x1.fffffep-1f)};
}

LightSample Lights::sample(glm::vec3 from, float u, float v) const {
  if (lights_.empty()) {
    return {};
  }
  const Choice choice = choose(u, v);
  return sample(*choice.light, from, choice.u, v);
}

LightSample Lights::sample(const Light& light, glm::vec3 from, float u, float v) const {
  LightSample s{};
  switch (light.kind) {
    case Kind::environment:
      s.direction = square_to_uniform_cap(u, v, -1.0f);
      s.distance = std::numeric_limits<float>::infinity();
      s.radiance = scene_->environment;
      s.pdf = light.probability * (1.0f / (4.0f * pi));
      break;
    case Kind::sphere:
      sample_sphere(light, from, u, v, s);
      break;
    case Kind::point: {
      const glm::vec3 to_light = light.origin - from;
      const float distance2 = glm::dot(to_light, to_light);
      const float distance = std::sqrt(distance2);
      s.direction = to_light * (1.0f / distance);
      s.distance = distance;
      s.radiance = light.radiance * (1.0f / distance2);
      s.pdf = light.probability;
      s.is_point = true;
      break;
    }
    default:
      sample_flat(light, from, u, v, s);
  }
  return s;
}

void Lights::sample_flat(const Light& light, glm::vec3 from, float u, float v,
                         LightSample& s) const {
  glm::vec2 p(u, v);
  if (light.kind == Kind::triangle) {
    p = square_to_triangle(u, v);
  } else if (light.kind == Kind::disk) {
    p = square_to_disk(u, v);
  }
  const glm::vec3 to_light = light.origin + p.x * light.edge1 + p.y * light.edge2 - from;
  const float distance2 = glm::dot(to_light, to_light);
  const float facing = -glm::dot(to_light, light.normal);
  if (!(facing > 0.0f)) {
    return;
  }
  const float distance = std::sqrt(distance2);
  s.direction = to_light * (1.0f / distance);
  s.distance = distance * short_of_light;
  s.radiance = light.textured ? radiance_at(light, from + to_light, p) : light.radiance;
  s.pdf = distance2 * distance * light.density / facing;
}

LightSample8 Lights::sample(const Vec8& from, Float8 u, Float8 v, Mask8 wanted) const {
  LightSample8 s{};
  if (lights_.empty()) {
    return s;
  }
  Float8 columns[2 * simd_lanes];
  Float8 probability{};
  Int8 kinds{};
  Mask8 textured{};
  const Light* lights[simd_lanes];
  if (lights_.size() == 1) {
    const Light& light = lights_.front();
    std::fill_n(lights, simd_lanes, &light);
    probability = splat(light.probability);
    kinds = int(light.kind) - Int8{};
    textured = -int(light.textured) - Int8{};
    for (int i = 0; i < 2 * simd_lanes; ++i) {
      columns[i] = splat((&light.origin.x)[i]);
    }
  } else {
    const float* rows[simd_lanes];
    for (int i = 0; i < simd_lanes; ++i) {
      const Choice choice = choose(u[i], v[i]);
      const Light& light = *choice.light;
      lights[i] = &light;
      u[i] = choice.u;
      probability[i] = light.probability;
      kinds[i] = int(light.kind);
      textured[i] = -int(light.textured);
      rows[i] = &light.origin.x;
    }
    // Half a cache line of each light at a time.
    transpose(rows, columns);
    for (const float*& row : rows) {
      row += simd_lanes;
    }
    transpose(rows, columns + simd_lanes);
  }
  const auto column = [&](int i) { return Vec8{columns[i], columns[i + 1], columns[i + 2]}; };

  s.is_point = kinds == int(Kind::point);
  const Mask8 triangle = kinds == int(Kind::triangle);
  const Mask8 disk = kinds == int(Kind::disk);
  Vec2x8 p{u, v};
  if (any(triangle)) {
    const Vec2x8 q = square_to_triangle(u, v);
    p = {triangle ? q.x : p.x, triangle ? q.y : p.y};
  }
  if (any(disk)) {
    const Vec2x8 q = square_to_disk(u, v);
    p = {disk ? q.x : p.x, disk ? q.y : p.y};
  }
  const Vec8 edges = column(0) + p.x * column(3) + p.y * column(6);
  const Vec8 to_light = select(s.is_point, column(0), edges) - from;
  const Float8 distance2 = dot(to_light, to_light);
  const Float8 facing = -dot(to_light, column(9));
  const Float8 distance = sqrt(distance2);
  s.direction = to_light * (1.0f / distance);
  s.distance = s.is_point ? distance : distance * short_of_light;
  const Vec8 radiance = column(12);
  s.radiance = select(facing > 0.0f, radiance, Vec8{});
  s.radiance = select(s.is_point, radiance * (1.0f / distance2), s.radiance);
  s.pdf = s.is_point ? probability : distance2 * distance * columns[15] / facing;

  // The others like single samples, one after the other.
  for_each_lane(wanted & ((kinds >= int(Kind::sphere)) | textured), [&](int i) {
    const LightSample one = sample(*lights[i], lane_of(from, i), u[i], v[i]);
    set_lane(s.direction, i, one.direction);
    s.distance[i] = one.distance;
    set_lane(s.radiance, i, one.radiance);
    s.pdf[i] = one.pdf;
  });
  return s;
}

void Lights::sample_sphere(const Light& light, glm::vec3 from, float u, float v,
                           LightSample& s) const {
  const Sphere& sphere = std::get<Sphere>(scene_->shapes[light.shape].geometry);
  const glm::vec3 to_center = light.origin - from;
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
      return;  // along the surface, or no way at all
    }
    s.pdf = length2 / cos_light * light.density;
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
    return;
  }
  s.radiance = radiance_at(light, light.origin + light.radius * outward, {});
}

float Lights::pdf(const Surface& surface, glm::vec3 from, glm::vec3 direction,
                  float distance) const {
  const int first = first_of_shape_[surface.shape];
  if (first < 0) {
    return 0.0f;
  }
  const Light* light = &lights_[std::size_t(first)];
  if (light->kind == Kind::triangle) {
    light += surface.primitive;
  }
  if (light->kind == Kind::sphere) {
    const glm::vec3 to_center = light->origin - from;
    const float distance2 = glm::dot(to_center, to_center);
    if (!sampled_by_area(distance2, light->radius)) {
      return light->probability / (2.0f * pi * one_minus_cos_cap(distance2, light->radius));
    }
  }
  const float cos_light = std::abs(glm::dot(direction, surface.normal));
  return cos_light > 0.0f ? light->density * distance * distance / cos_light : 0.0f;
}

float Lights::environment_pdf() const {
  return environment_ < 0 ? 0.0f
                          : lights_[std::size_t(environment_)].probability * (1.0f / (4.0f * pi));
}

glm::vec3 Lights::radiance_at(const Light& light, glm::vec3 position, glm::vec2 on_edges) const {
  const Shape& shape = scene_->shapes[light.shape];
  if (shape.radiance.texture == Color::no_texture) {
    return shape.radiance.value;
  }
  Hit hit{};
  hit.primitive = light.primitive;
  hit.u = on_edges.x;
  hit.v = on_edges.y;
  if (light.kind == Kind::parallelogram) {
    // Its triangles (0,1,2) and (0,2,3), with the barycentrics of their last two corners.
    hit.primitive = on_edges.x >= on_edges.y ? 0 : 1;
    hit.u = hit.primitive == 0 ? on_edges.x - on_edges.y : on_edges.x;
    hit.v = hit.primitive == 0 ? on_edges.y : on_edges.y - on_edges.x;
  }
  return color_at(*scene_, shape.radiance, uv_at(shape, position, hit));
}

}  // namespace quartet
