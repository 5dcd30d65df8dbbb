#include <fmt/format.h>
#include <imgui.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>

#include "app/commands/commands.h"
#include "app/options/usage_error.h"
#include "app/terminal/end_signals.h"
#include "app/terminal/messages.h"
#include "app/window/closing_time.h"
#include "app/window/config_file.h"
#include "app/window/imgui_screen.h"
#include "app/window/lab_driver.h"
#include "app/window/window.h"
#include "renderer/measure/reference/reference_cache.h"

namespace quartet {
namespace {

bool can_be_found(const std::string& scene) {
  try {
    lasting_scene_name(scene);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

/// What is under way when the window closes may take this long to end, and no longer.
constexpr auto closing_time = std::chrono::milliseconds(250);

void run_window(const WindowOptions& options) {
  // What must outlast all else comes first.
  const BlockedSignals signals;
  std::optional<ClosingTime> closing;
  const std::filesystem::path config = config_path();
  if (options.reset_settings && !config.empty()) {
    std::filesystem::remove(config);
  }
  LabState state = initial_state();
  WindowMemory memory;
  const std::string complaint = load_config(config, state, memory);
  if (!options.scene.empty()) {
    state.scene = lasting_scene_name(options.scene);
  } else if (!can_be_found(state.scene)) {
    state.scene = LabState().scene;  // the last one was moved away
  }
  state.ui_scale = options.ui_scale.value_or(state.ui_scale);

  Window window("Quartet", {memory.width, memory.height});
  std::atomic<bool> ended = false;
  const SignalWatch watch(signals, [&] {
    ended = true;
    window.wake();
  });
  ImguiScreen screen;
  const std::string scene = state.scene;
  LabDriver driver(
      std::move(state), window.gl(), [&window] { window.wake(); }, reference_cache_folder());
  if (!complaint.empty()) {
    driver.window().say(Message::Kind::error, complaint);
  }
  driver.load(scene);
  WindowHandlers handlers;
  handlers.key = [&](const KeyEvent& event) { driver.window().key(event); };
  handlers.drop = [&](const std::string& path) { driver.drop(path); };
  handlers.wants_to_close = [&] { return ended || driver.window().state().quit; };
  handlers.draw = [&](double seconds) {
    window.begin_imgui_frame();
    driver.begin_frame(screen, window.monitor_scale());
    const bool again = driver.draw(seconds);
    int width = 0;
    int height = 0;
    window.framebuffer_size(width, height);
    screen.end_frame(window.gl(), width, height);
    window.swap();
    return again;
  };
  const std::shared_ptr<void> attached = window.attach_imgui(std::move(handlers));
  window.run();
  const WindowSize size = window.size_at_scale_one();
  memory.width = size.width;
  memory.height = size.height;
  window.hide();
  if (!config.empty()) {
    LabState last = driver.window().state();
    if (can_be_found(last.scene)) {
      last.scene = lasting_scene_name(last.scene);
    }
    save_config(config, last, memory);
  }
  closing.emplace(closing_time);
}

/// The first of out, out-2, out-3, … that is not there, or empty: nobody asked for what is in one
/// to be replaced.
std::string unused_folder() {
  std::string name = "out";
  for (int i = 2;; ++i) {
    std::error_code error;
    if (!std::filesystem::exists(name, error) ||
        (std::filesystem::is_directory(name, error) && std::filesystem::is_empty(name, error) &&
         !error)) {
      return name;
    }
    name = fmt::format("out-{}", i);
  }
}

}  // namespace

void run_lab_window(const WindowOptions& options, const Program& program) {
  try {
    run_window(options);
  } catch (const NoDisplay& error) {
    const std::string out = unused_folder();
    tell(
        "no window: {}. Without one there are: quartet figure SCENE --out DIR, and quartet "
        "screenshot SCENE -o LAB.png. Writing the report's figures to {}/{}.",
        error.what(), out, out == "out" ? "" : ", as there are files in out/ already");
    run_default_figure(program, options.scene, out);
  }
}

}  // namespace quartet
