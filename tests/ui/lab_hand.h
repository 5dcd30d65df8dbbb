#pragma once

#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "app/window/imgui_screen.h"
#include "app/window/lab_driver.h"
#include "app/window/offscreen.h"
#include "ui/widgets/imgui_compat.h"

namespace quartet {

/// The lab window without a display, and a hand on its mouse and keys: what a user does, in
/// process. Widgets are found by the names that the window records.
class LabHand {
 public:
  /// References are cached in `reference_cache`, if it is not empty.
  explicit LabHand(int width = 1600, int height = 1000,
                   const std::filesystem::path& reference_cache = {})
      : offscreen_(width, height),
        driver_(
            small_lab(), offscreen_.gl(), [] {}, reference_cache) {
    ImGui::GetIO().DisplaySize = {float(width), float(height)};
    add_mouse_position(-100.0f, -100.0f);
    settle();
  }

  /// Four lanes over a picture small enough to be traced in a moment.
  static LabState small_lab() {
    LabState state = initial_state();
    set_scene(state, std::make_shared<const TraceScene>(load_scene(find_scene("cornell-checker"))));
    state.request.store.settings.width = 96;
    state.request.store.settings.height = 54;
    state.request.store.threads = 2;
    state.playback.set_target(5);
    return state;
  }

  LabWindow& window() { return driver_.window(); }
  LabState& state() { return driver_.window().state(); }
  LabDriver& driver() { return driver_; }
  const Snapshot& snapshot() { return *driver_.snapshot(); }
  const LaneSettings& settings(std::size_t lane) { return state().request.lanes.settings[lane]; }

  /// OpenGL, in software most of a frame's time, draws it only where somebody looks: screen().
  void frame(float seconds = 1.0f / 60.0f) {
    ImGui::GetIO().DeltaTime = seconds;
    seconds_ += double(seconds);
    driver_.begin_frame(screen_, 1.0f);
    driver_.draw(seconds_);
    ImGui::Render();
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) {
      frame();
    }
  }

  /// Until what is shown is the answer to what was asked.
  void settle() {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    frames(3);
    while (!driver_.settled()) {
      ASSERT_LT(std::chrono::steady_clock::now(), give_up) << "the renderer did not answer";
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      frame();
    }
    frames(3);
  }

  bool has(const std::string& name) { return window().ui().widgets.contains(name); }
  ScreenRect rect(const std::string& name) {
    EXPECT_TRUE(has(name)) << "there is no widget " << name;
    return has(name) ? window().ui().widgets.at(name) : ScreenRect{};
  }

  void move(float x, float y) {
    add_mouse_position(x, y);
    frames(2);
  }
  void press(bool down, int button = 0) {
    add_mouse_button(button, down);
    frames(2);
  }
  void click(float x, float y) {
    move(x, y);
    press(true);
    press(false);
    wait();
  }
  void click(const std::string& name) {
    const ScreenRect box = rect(name);
    click(box.center_x(), box.center_y());
  }
  /// From one point to another in small steps, as a hand does.
  void drag(float x0, float y0, float x1, float y1, int button = 0) {
    move(x0, y0);
    press(true, button);
    constexpr int steps = 10;
    for (int i = 1; i <= steps; ++i) {
      const float t = float(i) / steps;
      add_mouse_position(x0 + t * (x1 - x0), y0 + t * (y1 - y0));
      frame();
    }
    press(false, button);
    wait();
  }
  /// A widget's middle by so many pixels to the right.
  void drag(const std::string& name, float by) {
    const ScreenRect box = rect(name);
    drag(box.center_x(), box.center_y(), box.center_x() + by, box.center_y());
  }
  void wheel(float x, float y, float notches) {
    move(x, y);
    add_mouse_wheel(notches);
    frames(3);
  }
  /// Opens a combo box and takes a row.
  void choose(const std::string& combo, const std::string& row) {
    click(combo);
    frames(3);
    click(combo + "." + row);
  }
  void key(int key, bool shift = false) {
    window().key({key, true, shift, false});
    window().key({key, false, shift, false});
    frames(3);
  }
  void type(const std::string& text) {
    for (const char c : text) {
      ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
    }
    frames(2);
    add_enter_key(true);
    frames(2);
    add_enter_key(false);
    frames(3);
  }

  /// What is on screen in a widget.
  std::vector<Rgba8> pixels(const std::string& name) {
    const ScreenRect box = rect(name);
    const DisplayImage screen = this->screen();
    std::vector<Rgba8> inside;
    for (int y = int(box.y); y < int(box.bottom()); ++y) {
      for (int x = int(box.x); x < int(box.right()); ++x) {
        inside.push_back(screen.at(x, y));
      }
    }
    return inside;
  }
  DisplayImage screen() {
    screen_.end_frame(offscreen_.gl(), offscreen_.width(), offscreen_.height());
    return offscreen_.read();
  }

 private:
  /// Past the time of a double click, as one long frame among short ones.
  void wait() {
    frame(0.4f);
    frames(4);
  }

  Offscreen offscreen_;
  ImguiScreen screen_;
  LabDriver driver_;
  double seconds_ = 0.0;
};

/// The name of a widget of a lane.
inline std::string lane_widget(std::size_t lane, const std::string& what) {
  return "lane" + std::to_string(lane) + "." + what;
}

/// What is in the second picture, the heatmap, of every lane.
inline std::array<std::vector<Rgba8>, lane_count> heatmaps(LabHand& hand) {
  std::array<std::vector<Rgba8>, lane_count> all;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    all[lane] = hand.pixels(lane_widget(lane, "slot1"));
  }
  return all;
}

}  // namespace quartet
