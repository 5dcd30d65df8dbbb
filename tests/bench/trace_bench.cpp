// Tracing against the rays alone: how much of the time that Embree needs for the same rays is left
// when everything else (random numbers, shading, light sampling, storing) is added.

#include <benchmark/benchmark.h>

#include <chrono>
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

void retrace(const Accel& accel, const Recorder& recorder) {
  for (const RecordedRay& recorded : recorder.rays) {
    if (recorded.shadow) {
      benchmark::DoNotOptimize(accel.occluded(recorded.ray));
    } else {
      Hit hit;
      benchmark::DoNotOptimize(accel.closest_hit(recorded.ray, hit));
    }
  }
}

/// One thread: tracing and retracing in turn, so that both see the same machine.
void trace_against_rays_alone(benchmark::State& state) {
  const BenchScene bench("cornell-box", size, size);
  const CameraRays camera(bench.settings.camera, size, size);
  const auto trace = integrator(bench.settings.integrator).trace;
  const Recorder recorder = record(bench, 0);
  double tracing = 0.0;
  double retracing = 0.0;
  for (auto _ : state) {
    auto start = std::chrono::steady_clock::now();
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        glm::vec3 radiance;
        trace(*bench.scene, bench.settings, camera, x, y, 0, {&radiance, 1});
        benchmark::DoNotOptimize(radiance);
      }
    }
    tracing += seconds_since(start);
    start = std::chrono::steady_clock::now();
    retrace(bench.scene->accel(), recorder);
    retracing += seconds_since(start);
  }
  const double rays = double(recorder.rays.size()) * double(state.iterations());
  state.counters["Mpaths/s"] = double(size * size) * double(state.iterations()) / tracing * 1e-6;
  state.counters["Mrays/s"] = rays / tracing * 1e-6;
  state.counters["limit_Mrays/s"] = rays / retracing * 1e-6;
  state.counters["of_limit"] = retracing / tracing;
}
BENCHMARK(trace_against_rays_alone)->Unit(benchmark::kMillisecond)->MinTime(3.0);

/// Passes through the sample store with one thread and with two, in turn.
void two_threads_against_one(benchmark::State& state) {
  const BenchScene bench("cornell-box", size, size);
  const SamplingPolicy uniform = default_policy(EstimatorId::uniform);
  double seconds[2] = {0.0, 0.0};
  std::uint64_t samples = 0;
  for (auto _ : state) {
    for (const int threads : {1, 2}) {
      Lab lab = bench.lab(std::span(&uniform, 1), threads);
      for (int frame = 0; frame < 4; ++frame) {
        lab.run_frame();
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
