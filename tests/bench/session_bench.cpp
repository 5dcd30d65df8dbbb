// What a window waits for: submit and latest while the renderer works, a dragged threshold until
// its picture is there, and what it makes of a snapshot.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "renderer/session/session.h"
#include "renderer/view/lane_charts.h"
#include "renderer/view/views.h"
#include "tests/bench/bench_scene.h"

namespace quartet {
namespace {

constexpr int width = 480;
constexpr int height = 270;

LabRequest lab_request(std::size_t lanes, int threads) {
  const BenchScene bench("cornell-checker", width, height);
  LabRequest request;
  request.store.scene = bench.scene;
  request.store.settings = bench.settings;
  request.store.threads = threads;
  constexpr std::array ids{EstimatorId::contrast, EstimatorId::kl, EstimatorId::chi2,
                           EstimatorId::hellinger};
  for (std::size_t i = 0; i < lanes; ++i) {
    request.lanes.settings.push_back(default_settings(ids[i]));
  }
  return request;
}

/// Somebody who asks a session and sleeps until it has something new, as a window does.
class Client {
 public:
  Session& session() { return session_; }

  /// Submits a request, and returns once its snapshot at `pass` is there.
  void ask(LabRequest request, std::uint32_t pass) {
    const std::uint64_t number = session_.submit(std::move(request));
    const auto answered = [&] {
      const auto snapshot = session_.latest();
      return snapshot && snapshot->request >= number && snapshot->pass == pass;
    };
    std::unique_lock lock(mutex_);
    while (!answered()) {
      news_.wait(lock, [&] { return std::exchange(is_new_, false); });
    }
  }

 private:
  void wake() {
    {
      const std::lock_guard lock(mutex_);
      is_new_ = true;
    }
    news_.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable news_;
  bool is_new_ = false;
  Session session_{[this] { wake(); }};
};

/// Calls alternate with what a window does between two pictures, so that they meet the renderer at
/// any moment.
void calls_while_busy(benchmark::State& state) {
  Client client;
  Session& session = client.session();
  LabRequest request = lab_request(4, 0);
  request.lanes.pass = LaneRequest::no_end;
  client.ask(request, 1);
  std::vector<double> submits;
  std::vector<double> latests;
  const auto timed = [](std::vector<double>& times, const auto& call) {
    const Stopwatch watch;
    call();
    times.push_back(1e6 * watch.seconds());
  };
  int step = 0;
  std::shared_ptr<const Snapshot> shown;
  for (auto _ : state) {
    LabRequest next = request;
    next.lanes.settings[1].thresholds[0] *= 1.0f + 0.001f * float(++step % 100);
    timed(submits, [&] { session.submit(std::move(next)); });
    timed(latests, [&] { shown = session.latest(); });
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  for (auto [times, name] : {std::pair(&submits, "submit"), std::pair(&latests, "latest")}) {
    std::ranges::sort(*times);
    state.counters[std::string(name) + "_median_us"] = (*times)[times->size() / 2];
    state.counters[std::string(name) + "_worst_us"] = times->back();
  }
}
BENCHMARK(calls_while_busy)->Iterations(2000)->UseRealTime()->Unit(benchmark::kMillisecond);

/// From the request with other thresholds to the snapshot that answers it, all samples stored;
/// `measured`: with a reference, against which each pass is measured.
void drag_to_snapshot(benchmark::State& state, std::size_t lanes, std::size_t dragged, int threads,
                      bool measured = false) {
  Client client;
  const Session& session = client.session();
  LabRequest request = lab_request(lanes, threads);
  if (measured) {
    request.lanes.reference = std::make_shared<const RadianceImage>(width, height, glm::vec3(0.3f));
  }
  const std::vector<LaneSettings> original = request.lanes.settings;
  const auto drag_to = [&](int step) {
    for (std::size_t i = 0; i < dragged; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        request.lanes.settings[i].thresholds[c] =
            original[i].thresholds[c] * (1.0f + 0.01f * float(step));
      }
    }
    client.ask(request, request.lanes.pass);
  };
  constexpr int steps = 10;
  for (int step = 0; step < steps; ++step) {
    drag_to(step);
  }
  const std::uint64_t stored = session.status().stored_samples;
  int step = 0;
  for (auto _ : state) {
    drag_to(step++ % steps);
  }
  state.counters["replay_ms"] = 1e3 * session.status().replay_seconds;
  state.counters["traced"] = double(session.status().stored_samples - stored);
}
BENCHMARK_CAPTURE(drag_to_snapshot, the_only_lane_one_thread, 1, 1, 1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(drag_to_snapshot, one_lane_of_four_one_thread, 4, 1, 1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(drag_to_snapshot, four_lanes_two_threads, 4, 4, 2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

BENCHMARK_CAPTURE(drag_to_snapshot, one_lane_of_four_measured, 4, 1, 2, true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(drag_to_snapshot, four_lanes_measured, 4, 4, 2, true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void camera_to_first_picture(benchmark::State& state) {
  Client client;
  LabRequest request = lab_request(4, 2);
  for (auto _ : state) {
    request.store.settings.camera.origin.x += 1e-4f;
    client.ask(request, 1);
  }
}
BENCHMARK(camera_to_first_picture)->Unit(benchmark::kMillisecond)->UseRealTime();

void close_while_busy(benchmark::State& state) {
  LabRequest request = lab_request(4, 2);
  request.lanes.pass = LaneRequest::no_end;
  for (auto _ : state) {
    state.PauseTiming();
    auto client = std::make_unique<Client>();
    client->ask(request, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    state.ResumeTiming();
    client.reset();
  }
}
BENCHMARK(close_while_busy)->Iterations(5)->Unit(benchmark::kMillisecond)->UseRealTime();

Snapshot four_lanes_after(std::uint32_t passes) {
  const LabRequest request = lab_request(4, 2);
  LabOptions options;
  options.statistics.variance = true;
  Lab lab(sample_source(request.store.scene, request.store.settings), width, height,
          request.lanes.settings, options);
  while (lab.pass() < passes) {
    lab.run_pass();
  }
  Snapshot snapshot;
  copy_lanes(lab, snapshot);
  return snapshot;
}

void copy_of_four_lanes(benchmark::State& state) {
  const LabRequest request = lab_request(4, 2);
  Lab lab(sample_source(request.store.scene, request.store.settings), width, height,
          request.lanes.settings);
  while (lab.pass() < 15) {
    lab.run_pass();
  }
  Snapshot snapshot;
  for (auto _ : state) {
    copy_lanes(lab, snapshot);
  }
}
BENCHMARK(copy_of_four_lanes)->Unit(benchmark::kMillisecond);

void histograms_of_a_lane(benchmark::State& state) {
  const Snapshot snapshot = four_lanes_after(15);
  const LaneSnapshot& lane = snapshot.lanes[1];
  SampleHistogram samples;
  ErrorHistogram errors;
  for (auto _ : state) {
    fill_histogram(lane.taken, samples);
    fill_histogram(lane.error, errors);
  }
}
BENCHMARK(histograms_of_a_lane)->Unit(benchmark::kMillisecond);

void views_of_a_lane(benchmark::State& state) {
  static const Snapshot snapshot = four_lanes_after(15);
  const ViewRow& row = views()[std::size_t(state.range(0))];
  ViewSettings settings;
  settings.other = 1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(draw_view(snapshot, 0, row.key, settings));
  }
  state.SetLabel(std::string(row.id));
}
BENCHMARK(views_of_a_lane)->DenseRange(0, int(views().size()) - 1)->Unit(benchmark::kMillisecond);

void charts_of_a_lane(benchmark::State& state) {
  static const Snapshot snapshot = four_lanes_after(15);
  const ColorScale scale = heat_scale(snapshot, 0, HeatRange::linked);
  for (auto _ : state) {
    benchmark::DoNotOptimize(sample_chart(snapshot, 0, scale));
    benchmark::DoNotOptimize(
        error_chart(snapshot, 0, snapshot.lanes[0].settings.thresholds, {255, 160, 40}));
    benchmark::DoNotOptimize(progress_chart(snapshot, 0, {255, 160, 40}));
  }
}
BENCHMARK(charts_of_a_lane)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace quartet
