// A frame of the lab window on the software rasteriser, without a display: CPU time of all threads.

#include <benchmark/benchmark.h>
#include <imgui.h>
#include <sys/resource.h>

#include <chrono>
#include <thread>

#include "app/window/imgui_screen.h"
#include "app/window/lab_driver.h"
#include "app/window/offscreen.h"
#include "renderer/scene/load_scene.h"

namespace quartet {
namespace {

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// `fresh`: every frame shows other pictures, as while a threshold is dragged; else only the mouse
/// has moved.
void window_frame(benchmark::State& state, bool fresh) {
  constexpr int width = 1600;
  constexpr int height = 1000;
  LabState lab = initial_state();
  set_scene(lab, std::make_shared<const TraceScene>(load_scene(find_scene("cornell-checker"))));
  lab.request.store.settings.width = 480;
  lab.request.store.settings.height = 270;
  Offscreen offscreen(width, height);
  ImguiScreen screen;
  ImGui::GetIO().DisplaySize = {float(width), float(height)};
  LabDriver driver(std::move(lab), offscreen.gl(), [] {});
  const auto frame = [&] {
    ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
    driver.begin_frame(screen, 1.0f);
    driver.draw(0.0);
    screen.end_frame(offscreen.gl(), width, height);
    offscreen.gl().finish();
  };
  frame();
  while (!driver.settled()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    frame();
  }
  const double start = cpu_seconds();
  for (auto _ : state) {
    if (fresh) {
      driver.window().state().view.exposure += 0.001f;  // all pictures are drawn and uploaded
    }
    frame();
  }
  state.counters["cpu_ms"] = 1e3 * (cpu_seconds() - start) / double(state.iterations());
}
BENCHMARK_CAPTURE(window_frame, mouse_moved, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(window_frame, all_pictures_new, true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace quartet
