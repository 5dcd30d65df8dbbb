#include "renderer/trace/light_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <variant>

#include "renderer/base/image.h"
#include "renderer/base/math/warp.h"
#include "renderer/scene/limits.h"
#include "renderer/trace/lights/light_row.h"

namespace quartet {
namespace {

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

}  // namespace

LightSampler::LightSampler(const Scene& scene, glm::vec3 bounds_min, glm::vec3 bounds_max)
    : scene_(&scene), first_of_shape_(scene.shapes.size(), -1) {
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const Shape& shape = scene.shapes[i];
    if (shape.emits && luminance(average_color(scene.textures, shape.radiance)) > 0.0f) {
      first_of_shape_[i] = int(lights_.size());
      std::visit([&](const auto& geometry) { add_lights(geometry, std::uint32_t(i), lights_); },
                 shape.geometry);
    }
  }
  for (Light& light : lights_) {
    const Color& radiance = scene.shapes[light.shape].radiance;
    light.textured = radiance.is_textured();
    light.row.radiance = radiance.value;
  }
  const std::size_t of_shapes = lights_.size();
  std::visit([&](const auto& kind) { add_lights(kind, lights_); }, scene.environment);
  environment_ = lights_.size() > of_shapes ? int(of_shapes) : -1;
  can_be_met_ = !lights_.empty();
  for (const DeltaLight& light : scene.delta_lights) {
    std::visit([&](const auto& kind) { add_lights(kind, lights_); }, light);
  }
  if (lights_.size() > most_lights) {
    throw std::runtime_error(
        fmt::format("{} lights, at most {} are possible", lights_.size(), most_lights));
  }
  choose_by_power(0.5f * glm::length(bounds_max - bounds_min));
}

void LightSampler::choose_by_power(float scene_radius) {
  std::vector<double> power;
  double total = 0.0;
  for (const Light& light : lights_) {
    power.push_back(light.family->power(light, *scene_, scene_radius));
    total += power.back();
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
    if (light.area > 0.0f) {
      light.row.density = light.probability / light.area;
    }
    cdf_.push_back(until);
    before = until;
  }
}

/// The light of a number, and what is left of the number. What is left of few steps is few numbers,
/// and would sample the light in few places; `v`, which chooses the point with it, fills them up.
LightSampler::Choice LightSampler::choose(float u, float v) const {
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

LightSample LightSampler::sample(glm::vec3 from, float u, float v) const {
  if (lights_.empty()) {
    return {};
  }
  const Choice choice = choose(u, v);
  return choice.light->family->sample(*choice.light, *scene_, from, choice.u, v);
}

LightSample8 LightSampler::sample(const Vec8& from, Float8 u, Float8 v, Mask8 wanted) const {
  if (lights_.empty()) {
    return LightSample8{};
  }
  LightRow8 row;
  Float8 probability{};
  Int8 domains{};
  Mask8 textured{};
  const Light* lights[simd_lanes];
  if (lights_.size() == 1) {
    const Light& light = lights_.front();
    std::fill_n(lights, simd_lanes, &light);
    probability = splat(light.probability);
    domains = int(light.domain) - Int8{};
    textured = -int(light.textured) - Int8{};
    row = splat(light.row);
  } else {
    const LightRow* rows[simd_lanes];
    for (int i = 0; i < simd_lanes; ++i) {
      const Choice choice = choose(u[i], v[i]);
      const Light& light = *choice.light;
      lights[i] = &light;
      u[i] = choice.u;
      probability[i] = light.probability;
      domains[i] = int(light.domain);
      textured[i] = -int(light.textured);
      rows[i] = &light.row;
    }
    row = gather(rows);
  }
  LightSample8 s = sample_rows(row, domains, probability, from, u, v);
  // The others like single samples, one after the other.
  const Mask8 alone = (domains == int(LightDomain::alone)) | textured;
  for_each_lane(wanted & alone, [&](int i) {
    const LightSample one =
        lights[i]->family->sample(*lights[i], *scene_, lane_of(from, i), u[i], v[i]);
    set_lane(s.direction, i, one.direction);
    s.distance[i] = one.distance;
    set_lane(s.radiance, i, one.radiance);
    s.pdf[i] = one.pdf;
    s.is_point[i] = -int(one.is_point);
  });
  return s;
}

float LightSampler::pdf(const Surface& surface, glm::vec3 from, glm::vec3 direction,
                        float distance) const {
  const int first = first_of_shape_[surface.shape];
  if (first < 0) {
    return 0.0f;
  }
  const Light* light = &lights_[std::size_t(first)];
  // Lights of a shape of several pieces lie in the order of its pieces; only meshes have them.
  if (light->domain == LightDomain::triangle) {
    light += surface.primitive;
  }
  return light->family->pdf(*light, surface, from, direction, distance);
}

float LightSampler::environment_pdf() const {
  return environment_ < 0 ? 0.0f
                          : lights_[std::size_t(environment_)].probability * (1.0f / (4.0f * pi));
}

}  // namespace quartet
