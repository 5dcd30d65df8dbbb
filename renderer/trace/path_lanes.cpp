#include "renderer/trace/path_lanes.h"

#include <algorithm>

#include "renderer/base/math/warp.h"
#include "renderer/trace/path.h"
#include "renderer/trace/sampler8.h"

namespace quartet {
namespace {

/// Eight paths, each at a segment of its own: what trace_path keeps in its variables.
struct Paths {
  Mask8 active{};
  Ray8 ray{};
  Hit8 hit{};
  Sampler8 sampler;
  Vec8 radiance{};
  Vec8 throughput{};
  Float8 eta_scale{};
  Float8 bsdf_pdf{};
  Int8 depth{};
  Int8 rays{};
  SampleJob* jobs[simd_lanes];
  std::size_t samples[simd_lanes];  // of the jobs

  void trace(const TraceScene& scene) {
    hit = scene.accel().closest_hit(ray, active);
    rays -= active;
  }

  void finish(Mask8 ended) {
    for_each_lane(ended, [&](int lane) {
      SampleJob& job = *jobs[lane];
      job.radiance[samples[lane]] = lane_of(radiance, lane);
      job.work += rays[lane];
      if (!job.rays.empty()) {
        job.rays[samples[lane]] = std::uint16_t(std::min(rays[lane], int(UINT16_MAX)));
      }
    });
    active &= ~ended;
  }

  /// Goes on with lane `from` of others.
  void take(int lane, const Paths& other, int from) {
    active[lane] = -1;
    set_lane(ray.origin, lane, lane_of(other.ray.origin, from));
    set_lane(ray.direction, lane, lane_of(other.ray.direction, from));
    hit.met[lane] = other.hit.met[from];
    hit.t[lane] = other.hit.t[from];
    hit.u[lane] = other.hit.u[from];
    hit.v[lane] = other.hit.v[from];
    hit.shape[lane] = other.hit.shape[from];
    hit.primitive[lane] = other.hit.primitive[from];
    sampler.take(lane, other.sampler, from);
    set_lane(radiance, lane, glm::vec3(0.0f));
    set_lane(throughput, lane, glm::vec3(1.0f));
    eta_scale[lane] = 1.0f;
    bsdf_pdf[lane] = 0.0f;
    depth[lane] = 1;
    rays[lane] = 1;
    jobs[lane] = other.jobs[from];
    samples[lane] = other.samples[from];
  }
};

/// The paths of jobs, one after the other. Their first rays are made and traced eight at a time:
/// all from the camera, they go the same way through the hierarchy, which later ones do not.
class PathQueue {
 public:
  PathQueue(const TraceScene& scene, const RenderSettings& settings, const CameraRays& camera,
            std::span<SampleJob> jobs)
      : scene_(scene), settings_(settings), camera_(camera), jobs_(jobs) {
    for (SampleJob& job : jobs) {
      job.work = 0.0;
    }
    skip_empty_jobs();
  }

  /// Puts paths into the lanes that have none, while there are any.
  void fill(Paths& paths) {
    for_each_lane(~paths.active, [&](int lane) {
      if (next_ == made_) {
        make();
      }
      if (next_ < made_) {
        paths.take(lane, first_, next_++);
      }
    });
  }

 private:
  void make() {
    Word8 pixel{};
    Word8 index{};
    Int8 x{};
    Int8 y{};
    next_ = 0;
    first_.active = Mask8{};
    for (made_ = 0; made_ < simd_lanes && !jobs_.empty(); ++made_) {
      SampleJob& job = jobs_.front();
      first_.active[made_] = -1;
      first_.jobs[made_] = &job;
      first_.samples[made_] = sample_;
      pixel[made_] = std::uint32_t(job.y) * std::uint32_t(settings_.width) + std::uint32_t(job.x);
      index[made_] = job.first + std::uint32_t(sample_);
      x[made_] = job.x;
      y[made_] = job.y;
      ++sample_;
      skip_empty_jobs();
    }
    if (made_ > 0) {
      first_.sampler = Sampler8(settings_.seed, pixel, index, settings_.sampler);
      first_.ray = camera_.ray(__builtin_convertvector(x, Float8),
                               __builtin_convertvector(y, Float8), first_.sampler.next());
      first_.trace(scene_);
    }
  }

  void skip_empty_jobs() {
    while (!jobs_.empty() && sample_ == jobs_.front().radiance.size()) {
      jobs_ = jobs_.subspan(1);
      sample_ = 0;
    }
  }

  const TraceScene& scene_;
  const RenderSettings& settings_;
  const CameraRays& camera_;
  std::span<SampleJob> jobs_;  // of which no path was made yet
  std::size_t sample_ = 0;     // of the first of them
  Paths first_;                // made, those before next_ given away
  int next_ = 0;
  int made_ = 0;
};

/// The materials that eight paths met, where they are not diffuse. One array serves all vertices:
/// to make one is not free.
using Bsdfs = Bsdf[simd_lanes];

/// What eight paths met.
struct Vertices {
  Surface8 surface;
  Vec8 reflectance;
  Mask8 two_sided{};
  Mask8 diffuse;
  Mask8 specular{};
  const Bsdf* bsdfs;
};

Ray lane_of(const Ray8& rays, int lane) {
  return {lane_of(rays.origin, lane), lane_of(rays.direction, lane)};
}
Hit lane_of(const Hit8& hits, int lane) {
  return {hits.t[lane], hits.u[lane], hits.v[lane], hits.shape[lane], hits.primitive[lane]};
}

Vertices vertices_at(const TraceScene& scene, const Ray8& rays, const Hit8& hits, Mask8 wanted,
                     Bsdfs& bsdfs) {
  static constexpr Facet nothing{};
  Vertices vertices;
  vertices.diffuse = wanted;
  vertices.bsdfs = bsdfs;
  Facet made[simd_lanes];
  const Facet* facets[simd_lanes];
  Mask8 bent{};
  for (const Facet*& facet : facets) {
    facet = &nothing;
  }
  for_each_lane(wanted, [&](int i) {
    facets[i] = scene.plain_facet(hits.shape[i], hits.primitive[i]);
    vertices.two_sided[i] = -int(scene.two_sided(hits.shape[i]));
    if (!facets[i]) {
      // A surface of another kind comes as a facet without edges.
      const Surface surface = scene.surface(lane_of(rays, i), lane_of(hits, i));
      const Bsdf bsdf = scene.bsdf(surface);
      const Diffuse::AtPoint* diffuse = std::get_if<Diffuse::AtPoint>(&bsdf.kind);
      made[i] = {surface.position,
                 {},
                 {},
                 surface.normal,
                 surface.offset,
                 diffuse ? diffuse->reflectance : glm::vec3(0.0f)};
      facets[i] = &made[i];
      bent[i] = -1;
      set_lane(vertices.surface.shading_normal, i, surface.shading_normal);
      vertices.diffuse[i] = -int(diffuse != nullptr);
      if (!diffuse) {
        vertices.specular[i] = -int(is_specular(bsdf));
        bsdfs[i] = bsdf;
      }
    }
  });
  Columns columns(facets);
  const Facet8 facet{columns.vector(), columns.vector(), columns.vector(),
                     columns.vector(), columns.number(), columns.vector()};
  Surface8& surface = vertices.surface;
  surface.position = facet.corner + hits.u * facet.edge1 + hits.v * facet.edge2;
  surface.normal = facet.normal;
  surface.shading_normal = select(bent, surface.shading_normal, surface.normal);
  surface.offset = facet.offset;
  vertices.reflectance = facet.reflectance;
  return vertices;
}

struct BsdfValue8 {
  Vec8 f_cos;
  Float8 pdf;
};

/// evaluate() of eight materials.
BsdfValue8 evaluate(const Vertices& vertices, const Vec8& wo, const Vec8& wi, Mask8 wanted) {
  const Mask8 below = wo.z < 0.0f;
  const Mask8 none = (wo.z * wi.z <= 0.0f) | (below & ~vertices.two_sided);
  const Float8 cosine = below ? -wi.z : wi.z;
  const Float8 pdf = none ? Float8{} : cosine * (1.0f / pi);
  BsdfValue8 value{vertices.reflectance * pdf, pdf};
  for_each_lane(wanted & ~vertices.diffuse, [&](int i) {
    const BsdfValue one = evaluate(vertices.bsdfs[i], lane_of(wo, i), lane_of(wi, i));
    set_lane(value.f_cos, i, one.f_cos);
    value.pdf[i] = one.pdf;
  });
  return value;
}

struct BsdfSample8 {
  Vec8 wi;
  Vec8 weight;
  Float8 pdf;
  Float8 eta_scale;
};

/// sample() of eight materials.
BsdfSample8 sample(const Vertices& vertices, const Vec8& wo, Float8 u, Float8 v, Mask8 wanted) {
  const Mask8 below = wo.z < 0.0f;
  BsdfSample8 s;
  s.wi = square_to_cosine_hemisphere(u, v);
  s.pdf = s.wi.z * (1.0f / pi);
  const Mask8 none = (wo.z == 0.0f) | (below & ~vertices.two_sided) | ~(s.pdf > 0.0f);
  s.weight = select(none, Vec8{}, vertices.reflectance);
  s.wi.z = below ? -s.wi.z : s.wi.z;
  s.eta_scale = splat(1.0f);
  for_each_lane(wanted & ~vertices.diffuse, [&](int i) {
    const BsdfSample one = sample(vertices.bsdfs[i], lane_of(wo, i), u[i], v[i]);
    set_lane(s.wi, i, one.wi);
    set_lane(s.weight, i, one.weight);
    s.pdf[i] = one.specular ? 0.0f : one.pdf;
    s.eta_scale[i] = one.eta_scale;
  });
  return s;
}

/// Adds the light that paths ran into.
template <bool NextEvent>
void add_found_light(const TraceScene& scene, Paths& paths) {
  if (!scene.lights().can_be_met()) {
    return;
  }
  const Hit8& hits = paths.hit;
  const Mask8 missed = paths.active & ~hits.met;
  const Mask8 weighted = NextEvent ? paths.bsdf_pdf > 0.0f : Mask8{};
  if (any(missed)) {
    const Float8 weight =
        weighted ? detail::power_heuristic(paths.bsdf_pdf, splat(scene.lights().environment_pdf()))
                 : 1.0f;
    const Vec8 light = weight * paths.throughput * scene.environment(paths.ray.direction);
    paths.radiance = select(missed, paths.radiance + light, paths.radiance);
  }
  for_each_lane(paths.active & hits.met, [&](int i) {
    if (!scene.emits(hits.shape[i])) {
      return;
    }
    const Ray ray = lane_of(paths.ray, i);
    const Surface surface = scene.surface(ray, lane_of(hits, i));
    const glm::vec3 emitted = scene.emitted(surface, ray.direction);
    if (emitted != glm::vec3(0.0f)) {
      const float weight =
          weighted[i] ? detail::power_heuristic(
                            paths.bsdf_pdf[i],
                            scene.lights().pdf(surface, ray.origin, ray.direction, hits.t[i]))
                      : 1.0f;
      set_lane(paths.radiance, i,
               lane_of(paths.radiance, i) + weight * lane_of(paths.throughput, i) * emitted);
    }
  });
}

/// Adds the light that paths find at a vertex by sampling a light, in the lanes of `wanted`.
void add_next_event(const TraceScene& scene, const Vertices& vertices, const FrameOf<Float8>& frame,
                    const Vec8& wo, const Sampler8::Draws& draws, Mask8 wanted, Paths& paths) {
  const Vec8 origin = offset_origin(vertices.surface, -paths.ray.direction);
  const LightSample8 light = scene.lights().sample(origin, draws[0], draws[1], wanted);
  Mask8 lit = wanted & ~is_zero(light.radiance) & ~detail::leaks(vertices.surface, light.direction);
  const BsdfValue8 value = evaluate(vertices, wo, frame.to_local(light.direction), lit);
  lit &= ~is_zero(value.f_cos);
  if (!any(lit)) {
    return;
  }
  paths.rays -= lit;
  lit &= ~scene.accel().occluded({origin, light.direction, light.distance}, lit);
  const Float8 weight = light.is_point ? 1.0f : detail::power_heuristic(light.pdf, value.pdf);
  const Vec8 reflected = light.radiance * value.f_cos * (weight / light.pdf);
  paths.radiance = select(lit, paths.radiance + paths.throughput * reflected, paths.radiance);
}

/// Moves all active paths on, from what they met to their next rays.
template <bool NextEvent>
void advance(const TraceScene& scene, const RenderSettings& settings, Bsdfs& bsdfs, Paths& paths) {
  const int max_depth = settings.max_depth;
  add_found_light<NextEvent>(scene, paths);
  paths.finish(paths.active & ~(paths.hit.met & (paths.depth < max_depth)));
  if (!any(paths.active)) {
    return;
  }

  const Vertices vertices = vertices_at(scene, paths.ray, paths.hit, paths.active, bsdfs);
  const Surface8& surface = vertices.surface;
  const FrameOf<Float8> frame(surface.shading_normal);
  const Vec8 wo = frame.to_local(-paths.ray.direction);
  const Sampler8::Draws draws = paths.sampler.next();
  if (NextEvent) {
    add_next_event(scene, vertices, frame, wo, draws, paths.active & ~vertices.specular, paths);
  }

  const BsdfSample8 next = sample(vertices, wo, draws[2], draws[3], paths.active);
  paths.throughput *= next.weight;
  const Vec8 direction = frame.to_world(next.wi);
  paths.eta_scale *= next.eta_scale;
  Mask8 ends = is_zero(paths.throughput) | detail::leaks(surface, direction);
  if (!scene.lights().can_be_met()) {
    ends |= paths.depth + 1 >= max_depth;
  }
  const Float8 strongest =
      max_of(max_of(paths.throughput.x, paths.throughput.y), paths.throughput.z);
  const Float8 survival = min_of(splat(detail::max_survival), paths.eta_scale * strongest);
  const Mask8 roulette = paths.depth >= detail::roulette_depth(settings.roulette);
  ends |= roulette & (paths.sampler.independent() >= survival);
  paths.finish(paths.active & ends);
  paths.throughput /= roulette ? survival : 1.0f;
  paths.bsdf_pdf = next.pdf;
  paths.ray = {offset_origin(surface, direction), direction};
  paths.depth += 1;
}

}  // namespace

template <bool NextEvent>
void trace_lanes(const TraceScene& scene, const RenderSettings& settings, const CameraRays& camera,
                 std::span<SampleJob> jobs) {
  PathQueue queue(scene, settings, camera, jobs);
  Paths paths;
  Bsdfs bsdfs;
  for (queue.fill(paths); any(paths.active); queue.fill(paths)) {
    advance<NextEvent>(scene, settings, bsdfs, paths);
    paths.trace(scene);
  }
}

template void trace_lanes<false>(const TraceScene&, const RenderSettings&, const CameraRays&,
                                 std::span<SampleJob>);
template void trace_lanes<true>(const TraceScene&, const RenderSettings&, const CameraRays&,
                                std::span<SampleJob>);

}  // namespace quartet
