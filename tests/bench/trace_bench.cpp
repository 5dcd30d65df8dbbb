// Tracing against the rays alone: the time that Embree needs for the same rays one by one, over
// that of everything (random numbers, shading, light sampling, and the rays in packets).

#include <benchmark/benchmark.h>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <vector>

#include "renderer/trace/path.h"
#include "tests/bench/bench_scene.h"

namespace quartet {
namespace {

constexpr int size = 256;

struct RecordedRay {
  Ray ray;
  bool shadow;
};

struct Recorder : NoObserver {
  std::vector<RecordedRay> rays;
  void closest_hit(const Ray& ray) { rays.push_back({ray, false}); }
  void occluded(const Ray& ray) { rays.push_back({ray, true}); }
};

Recorder record(const BenchScene& bench, std::uint32_t index) {
  const RenderSettings& settings = bench.settings;
  const CameraRays camera(settings.camera, settings.width, settings.height);
  Recorder recorder;
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) {
      Sampler sampler(settings.seed, std::uint32_t(y * settings.width + x), index);
      const Ray ray = camera.ray(x, y, sampler.next());
      trace_path<true>(*bench.scene, ray, sampler, settings.max_depth, recorder);
    }
  }
  return recorder;
}

RTCRayHit query_of(const Ray& ray) {
  RTCRayHit query;
  query.ray = {.org_x = ray.origin.x,
               .org_y = ray.origin.y,
               .org_z = ray.origin.z,
               .tnear = 0.0f,
               .dir_x = ray.direction.x,
               .dir_y = ray.direction.y,
               .dir_z = ray.direction.z,
               .time = 0.0f,
               .tfar = ray.t_max,
               .mask = ~0u,
               .id = 0,
               .flags = 0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

/// One ray at a time, in the order of the paths, by the plainest calls that Embree has.
void retrace(RTCScene scene, const Recorder& recorder) {
  for (const RecordedRay& recorded : recorder.rays) {
    RTCRayHit query = query_of(recorded.ray);
#if RTC_VERSION_MAJOR >= 4
    recorded.shadow ? rtcOccluded1(scene, &query.ray) : rtcIntersect1(scene, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    recorded.shadow ? rtcOccluded1(scene, &context, &query.ray)
                    : rtcIntersect1(scene, &context, &query);
#endif
    benchmark::DoNotOptimize(query);
  }
}

/// One thread: tracing and retracing in turn, so that both see the same machine.
void trace_against_rays_alone(benchmark::State& state, const char* scene) {
  const BenchScene bench(scene, size, size);
  const SampleSource source = sample_source(bench.scene, bench.settings);
  // In batches of the sample store's size.
  constexpr int rows = 4;
  std::vector<glm::vec3> radiance(std::size_t(size * rows));
  std::vector<SampleJob> jobs;
  const Recorder recorder = record(bench, 0);
  double tracing = 0.0;
  double retracing = 0.0;
  for (auto _ : state) {
    const Stopwatch tracing_watch;
    for (int top = 0; top < size; top += rows) {
      jobs.clear();
      for (int i = 0; i < size * rows; ++i) {
        jobs.push_back(
            {i % size, top + i / size, 0, std::span(radiance).subspan(std::size_t(i), 1)});
      }
      source(jobs);
      benchmark::DoNotOptimize(radiance.data());
    }
    tracing += tracing_watch.seconds();
    const Stopwatch retracing_watch;
    retrace(bench.scene->accel().embree_scene(), recorder);
    retracing += retracing_watch.seconds();
  }
  const double rays = double(recorder.rays.size()) * double(state.iterations());
  state.counters["rays/path"] = double(recorder.rays.size()) / double(size * size);
  state.counters["Mpaths/s"] = double(size * size) * double(state.iterations()) / tracing * 1e-6;
  state.counters["Mrays/s"] = rays / tracing * 1e-6;
  state.counters["limit_Mrays/s"] = rays / retracing * 1e-6;
  state.counters["of_limit"] = retracing / tracing;
}
BENCHMARK_CAPTURE(trace_against_rays_alone, cornell_box, "cornell-box")
    ->Unit(benchmark::kMillisecond)
    ->MinTime(3.0);
// The scene of against_embree.sh: what its race would take if all but the rays took no time.
BENCHMARK_CAPTURE(trace_against_rays_alone, embree_cornell,
                  QUARTET_BENCH_SCENES "/embree-cornell.xml")
    ->Unit(benchmark::kMillisecond)
    ->MinTime(3.0);

/// Passes through the sample store with one thread and with two, in turn.
void two_threads_against_one(benchmark::State& state) {
  const BenchScene bench("cornell-box", size, size);
  const LaneSettings uniform = default_settings(EstimatorId::uniform);
  double seconds[2] = {0.0, 0.0};
  std::uint64_t samples = 0;
  for (auto _ : state) {
    for (const int threads : {1, 2}) {
      Lab lab = bench.lab(std::span(&uniform, 1), threads);
      for (int pass = 0; pass < 4; ++pass) {
        lab.run_pass();
      }
      seconds[threads - 1] += lab.store().seconds();
      samples += threads == 1 ? lab.store().traced() : 0;
    }
  }
  state.counters["Mpaths/s_1"] = double(samples) / seconds[0] * 1e-6;
  state.counters["Mpaths/s_2"] = double(samples) / seconds[1] * 1e-6;
  state.counters["speedup"] = seconds[0] / seconds[1];
}
BENCHMARK(two_threads_against_one)->Unit(benchmark::kMillisecond)->MinTime(3.0)->UseRealTime();

}  // namespace
}  // namespace quartet
