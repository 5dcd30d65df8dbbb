#pragma once

#include <algorithm>
#include <limits>

#include "renderer/trace/frame.h"
#include "renderer/trace/sampler.h"
#include "renderer/trace/trace_scene.h"

namespace quartet {

/// Why a path ended.
enum class PathEnd {
  escaped,   ///< its last ray met nothing
  depth,     ///< it had as many segments as it may have
  absorbed,  ///< the material sends nothing on in the direction drawn, or drew none
  leaked,    ///< the direction lies behind the shading surface or behind the real one, not both
  roulette,
};

/// What may watch a path being traced, in the order in which things happen. This one watches
/// nothing and costs nothing; others hide the functions that they want.
struct NoObserver {
  /// A ray of the path is about to be traced.
  void closest_hit(const Ray&) {}
  /// It met nothing; the environment's radiance counts with a weight of the power heuristic.
  void missed(glm::vec3 /*environment*/, float /*weight*/) {}
  /// It met a surface, after `distance`; `throughput` is that of the path up to here.
  void vertex(const Surface&, float /*distance*/, glm::vec3 /*throughput*/) {}
  /// The surface shines; the same weight.
  void emitted(glm::vec3 /*radiance*/, float /*weight*/) {}
  /// A ray to a light is about to be traced.
  void occluded(const Ray&) {}
  /// The light was seen: its sample, the BSDF's value and density for its direction, the weight of
  /// the power heuristic, and the radiance that is reflected, which times throughput counts.
  void direct(const LightSample&, const BsdfValue&, float /*weight*/, glm::vec3 /*reflected*/) {}
  /// The BSDF was sampled, whether the path goes on or not.
  void scattered(const BsdfSample&, glm::vec3 /*direction*/) {}
  void survival(float /*probability*/) {}
  void ended(PathEnd) {}
};

namespace detail {

// Paths that end before their third vertex cost more in noise than they save in rays.
inline constexpr int first_roulette_depth = 3;
inline constexpr int roulette_depth(bool roulette) {
  return roulette ? first_roulette_depth : std::numeric_limits<int>::max();
}
// Every path must end, between perfect mirrors too.
inline constexpr float max_survival = 0.95f;

/// Veach 1997, section 9.2.4, with β = 2. A ratio, because squared densities leave the range of
/// float for small lights far away.
template <class F>
F power_heuristic(F pdf, F other) {
  const F ratio = other / pdf;
  return 1.0f / (1.0f + ratio * ratio);
}

/// A direction must lie on the same side of the shading and of the geometric surface, or light
/// would leak through the triangles of a smooth mesh.
template <class AnySurface, class Vector>
auto leaks(const AnySurface& surface, const Vector& direction) {
  return dot(direction, surface.normal) * dot(direction, surface.shading_normal) < 0.0f;
}

/// Direct light at a vertex, found by sampling a light; its share of the power heuristic.
template <class Observer>
glm::vec3 next_event(const TraceScene& scene, const Surface& surface, const Frame& frame,
                     const Bsdf& bsdf, glm::vec3 incoming, glm::vec3 wo,
                     const Sampler::Draws& draws, Observer& observer) {
  // A material reflects towards the side it is seen from; there the next ray will start too, so
  // that both ways to a light begin at the same point.
  const glm::vec3 origin = offset_origin(surface, -incoming);
  const LightSample light = scene.lights().sample(origin, draws[0], draws[1]);
  if (light.radiance == glm::vec3(0.0f) || leaks(surface, light.direction)) {
    return glm::vec3(0.0f);
  }
  const BsdfValue value = evaluate(bsdf, wo, frame.to_local(light.direction));
  if (value.f_cos == glm::vec3(0.0f)) {
    return glm::vec3(0.0f);
  }
  const Ray shadow{origin, light.direction, light.distance};
  observer.occluded(shadow);
  if (scene.accel().occluded(shadow)) {
    return glm::vec3(0.0f);
  }
  const float weight = light.is_point ? 1.0f : power_heuristic(light.pdf, value.pdf);
  const glm::vec3 reflected = light.radiance * value.f_cos * (weight / light.pdf);
  observer.direct(light, value, weight, reflected);
  return reflected;
}

}  // namespace detail

/// The radiance that arrives along `ray`, an unbiased estimate by unidirectional path tracing of
/// the rendering equation (Kajiya 1986). With `NextEvent`, each diffuse or glossy vertex also
/// samples a light, and both ways of finding light are weighted by the power heuristic; without it,
/// light is found by BSDF sampling alone. `max_depth` counts segments: 1 shows lights only. Without
/// `roulette` nothing but it, light or a black surface ends a path.
template <bool NextEvent, class Observer>
glm::vec3 trace_path(const TraceScene& scene, Ray ray, Sampler& sampler, int max_depth,
                     Observer& observer, bool roulette = true) {
  glm::vec3 radiance(0.0f);
  glm::vec3 throughput(1.0f);
  float eta_scale = 1.0f;
  // Of the direction that `ray` was sampled with; 0 where no light sample could have found it.
  float bsdf_pdf = 0.0f;
  for (int depth = 1;; ++depth) {
    Hit hit;
    observer.closest_hit(ray);
    if (!scene.accel().closest_hit(ray, hit)) {
      const float weight = NextEvent && bsdf_pdf > 0.0f
                               ? detail::power_heuristic(bsdf_pdf, scene.lights().environment_pdf())
                               : 1.0f;
      const glm::vec3 environment = scene.environment(ray.direction);
      observer.missed(environment, weight);
      observer.ended(PathEnd::escaped);
      return radiance + weight * throughput * environment;
    }
    const Surface surface = scene.surface(ray, hit);
    observer.vertex(surface, hit.t, throughput);
    const glm::vec3 emitted = scene.emitted(surface, ray.direction);
    if (emitted != glm::vec3(0.0f)) {
      const float weight =
          NextEvent && bsdf_pdf > 0.0f
              ? detail::power_heuristic(
                    bsdf_pdf, scene.lights().pdf(surface, ray.origin, ray.direction, hit.t))
              : 1.0f;
      observer.emitted(emitted, weight);
      radiance += weight * throughput * emitted;
    }
    if (depth >= max_depth) {
      observer.ended(PathEnd::depth);
      return radiance;
    }

    const Bsdf bsdf = scene.bsdf(surface);
    const Frame frame(surface.shading_normal);
    const glm::vec3 wo = frame.to_local(-ray.direction);
    const Sampler::Draws& draws = sampler.next();
    if (NextEvent && !is_specular(bsdf)) {
      radiance += throughput * detail::next_event(scene, surface, frame, bsdf, ray.direction, wo,
                                                  draws, observer);
    }

    if (depth + 1 >= max_depth && !scene.lights().can_be_met()) {
      observer.ended(PathEnd::depth);
      return radiance;
    }
    const BsdfSample next = sample(bsdf, wo, draws[2], draws[3]);
    throughput *= next.weight;
    const glm::vec3 direction = frame.to_world(next.wi);
    observer.scattered(next, direction);
    if (throughput == glm::vec3(0.0f)) {
      observer.ended(PathEnd::absorbed);
      return radiance;
    }
    if (detail::leaks(surface, direction)) {
      observer.ended(PathEnd::leaked);
      return radiance;
    }
    eta_scale *= next.eta_scale;
    if (depth >= detail::roulette_depth(roulette)) {
      const float survival = std::min(
          detail::max_survival, eta_scale * std::max({throughput.x, throughput.y, throughput.z}));
      observer.survival(survival);
      if (sampler.independent() >= survival) {
        observer.ended(PathEnd::roulette);
        return radiance;
      }
      throughput /= survival;
    }
    bsdf_pdf = next.specular ? 0.0f : next.pdf;
    ray = Ray{offset_origin(surface, direction), direction};
  }
}

}  // namespace quartet
