// The estimators over a whole picture, one thread.

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <random>
#include <string>
#include <vector>

#include "renderer/adaptive/estimators/estimator.h"
#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/policy.h"

namespace quartet {
namespace {

constexpr int width = 960;
constexpr int height = 540;

/// With what an estimator needs, of 16 samples a pixel; one where the means are all it needs.
Film noisy_film(FilmStatistics statistics = {}) {
  Film film(width, height, statistics);
  std::mt19937 random(1);
  std::exponential_distribution<float> radiance(1.0f);
  std::vector<glm::vec3> samples(statistics.any() ? 16 : 1);
  for (std::size_t i = 0; i < film.size(); ++i) {
    for (glm::vec3& sample : samples) {
      sample = {radiance(random), radiance(random), radiance(random)};
    }
    film.add(i, samples);
  }
  return film;
}

void per_pixel(benchmark::State& state) {
  state.counters["s/pixel"] =
      benchmark::Counter(double(width * height), benchmark::Counter::kIsIterationInvariantRate |
                                                     benchmark::Counter::kInvert);
}

void estimate(benchmark::State& state, const Estimator& row) {
  const Film film = noisy_film(row.needs);
  const RadianceImage reference(width, height, glm::vec3(1.0f));
  std::vector<float> error(std::size_t(row.channels) * film.size());
  tbb::task_arena(1).execute([&] {
    for (auto _ : state) {
      row.estimate({film, reference.pixels()}, error);
      benchmark::DoNotOptimize(error.data());
    }
  });
  per_pixel(state);
}

void plan(benchmark::State& state) {
  const Film film = noisy_film();
  const LaneSettings settings = default_settings(EstimatorId::kl);
  std::vector<float> error(film.size());
  estimator(settings.estimator).estimate({film}, error);
  Plan next;
  tbb::task_arena(1).execute([&] {
    for (auto _ : state) {
      plan_next(settings, {width, height, error, film.counts(), 1}, next);
      benchmark::DoNotOptimize(next.total);
    }
  });
  per_pixel(state);
}
BENCHMARK(plan)->Name("plan/vote")->Unit(benchmark::kMillisecond);

[[maybe_unused]] const bool registered = [] {
  for (const Estimator& row : estimators()) {
    if (row.estimate) {
      benchmark::RegisterBenchmark(("estimate/" + std::string(row.id)).c_str(),
                                   [&row](benchmark::State& state) { estimate(state, row); })
          ->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace quartet
