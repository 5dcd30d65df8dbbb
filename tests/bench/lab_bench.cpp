// Four lanes over one store: against one lane, against four separate runs, and replayed.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>

#include "renderer/base/interval.h"
#include "tests/bench/bench_scene.h"

namespace quartet {
namespace {

constexpr std::uint32_t passes = 15;
constexpr int width = 480;
constexpr int height = 270;

std::vector<LaneSettings> four_lanes() {
  std::vector<LaneSettings> lane_settings;
  for (const EstimatorId id :
       {EstimatorId::contrast, EstimatorId::kl, EstimatorId::chi2, EstimatorId::hellinger}) {
    lane_settings.push_back(default_settings(id));
  }
  return lane_settings;
}

double run(Lab& lab) {
  const Stopwatch watch;
  while (lab.pass() < passes) {
    lab.run_pass();
  }
  return watch.seconds();
}

void four_lanes(benchmark::State& state) {
  const BenchScene bench("cornell-checker", width, height);
  const auto lane_settings = four_lanes();
  double together = 0.0;
  double separate = 0.0;
  double dearest = 0.0;
  for (auto _ : state) {
    Lab lab = bench.lab(lane_settings, 2);
    together += run(lab);
    double most = 0.0;
    for (const LaneSettings& settings : lane_settings) {
      Lab alone = bench.lab(std::span(&settings, 1), 2);
      const double seconds = run(alone);
      separate += seconds;
      most = std::max(most, seconds);
    }
    dearest += most;
  }
  state.counters["to_dearest"] = together / dearest;
  state.counters["to_separate"] = together / separate;
}
BENCHMARK(four_lanes)->Unit(benchmark::kMillisecond)->Iterations(2)->UseRealTime();

/// Replays lanes of one lab out of stored samples, pass by pass or as many passes as go at once:
/// against each other, both in one round.
void replay(benchmark::State& state, std::size_t lanes, int threads) {
  const int picture_width = int(state.range(0));
  const int picture_height = picture_width * 9 / 16;
  const BenchScene bench("cornell-checker", picture_width, picture_height);
  const auto lane_settings = four_lanes();
  Lab lab = bench.lab(lane_settings, threads, std::size_t(16) << 30);
  run(lab);
  std::vector<double> by_pass;
  std::vector<double> at_once;
  for (auto _ : state) {
    for (const bool together : {false, true}) {
      for (std::size_t i = 0; i < lanes; ++i) {
        lab.set_settings(i, lane_settings[i]);
      }
      const Stopwatch watch;
      while (lab.pass() < passes) {
        together ? lab.run_passes(passes) : lab.run_pass();
      }
      (together ? at_once : by_pass).push_back(watch.seconds());
    }
  }
  const double places = double(picture_width) * picture_height * passes * double(lanes);
  state.counters["ms"] = median(at_once) * 1e3;
  state.counters["ns/pixel"] = median(at_once) / places * 1e9;
  state.counters["to_pass_by_pass"] = median(at_once) / median(by_pass);
  const SampleStore& store = lab.store();
  state.counters["B/sample"] = double(store.bytes()) / double(store.stored());
  const Film& film = lab.lanes().front().film();
  state.counters["B/pixel"] = double(film.bytes()) / double(film.size());
}

void in_seven_rounds(benchmark::internal::Benchmark* bench) {
  bench->Iterations(7)->Unit(benchmark::kMillisecond)->UseRealTime();
}
BENCHMARK_CAPTURE(replay, four_lanes_two_threads, 4, 2)
    ->Arg(480)
    ->Arg(960)
    ->Arg(1920)
    ->Apply(in_seven_rounds);
BENCHMARK_CAPTURE(replay, one_lane_two_threads, 1, 2)
    ->Arg(480)
    ->Arg(960)
    ->Arg(1920)
    ->Apply(in_seven_rounds);
BENCHMARK_CAPTURE(replay, one_lane_one_thread, 1, 1)->Arg(480)->Apply(in_seven_rounds);

/// Replays one lane with an estimator that wants the samples themselves, not only their means.
void replay_samples(benchmark::State& state, EstimatorId id) {
  const BenchScene bench("cornell-checker", width, height);
  LaneSettings settings = default_settings(id);
  settings.policy.kind = PolicyId::vote;
  Lab lab = bench.lab(std::span(&settings, 1), 1);
  run(lab);
  for (auto _ : state) {
    lab.set_settings(0, settings);
    run(lab);
  }
  const auto samples = double(lab.lanes().front().history().back().samples);
  state.counters["s/sample"] = benchmark::Counter(
      samples, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  const Film& film = lab.lanes().front().film();
  state.counters["B/pixel"] = double(film.bytes()) / double(film.size());
}
BENCHMARK_CAPTURE(replay_samples, rigau_kl, EstimatorId::rigau_kl)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replay_samples, rigau_chi2, EstimatorId::rigau_chi2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replay_samples, cycles, EstimatorId::cycles)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace quartet
