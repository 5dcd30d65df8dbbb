// A monkey at the window: random events into its contents, in process. What it must find is that
// nothing ends the program and that what the window knows stays within what it says.
//
// QUARTET_MONKEY_EVENTS=20000 for a long run, QUARTET_MONKEY_SEED for another one. A failure, also
// a signal or a sanitizer's report, says seed and event; the same two end where they ended, as far
// as the threads behind the window let them.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cfloat>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "app/window/imgui_screen.h"
#include "app/window/lab_driver.h"
#include "app/window/offscreen.h"
#include "renderer/files/exr.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/synthetic.h"
#include "tests/app/ball_scene.h"
#include "tests/files/temp_folder.h"
#include "ui/widgets/imgui_compat.h"
#include "ui/window/lab_layout.h"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/common_interface_defs.h>
#endif

namespace quartet {
namespace {

// What a signal handler can say.
std::array<char, 64> where_it_is{};

void say_where_it_is() {
  const std::size_t length = std::char_traits<char>::length(where_it_is.data());
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, where_it_is.data(), length);
}

extern "C" void die_loudly(int signal) {
  say_where_it_is();
  raise(signal);  // its handler is the usual one again
}

void tell_of_deaths() {
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGILL, SIGBUS}) {
    struct sigaction action {};
    action.sa_handler = die_loudly;
    action.sa_flags = int(SA_RESETHAND) | SA_NODEFER;
#ifdef __SANITIZE_ADDRESS__
    if (signal != SIGABRT) {
      continue;  // the sanitizer has more to say of them
    }
#endif
    sigaction(signal, &action, nullptr);
  }
#ifdef __SANITIZE_ADDRESS__
  __sanitizer_set_death_callback(say_where_it_is);
#endif
}

unsigned long number_from(const char* variable, unsigned long otherwise) {
  const char* const text = std::getenv(variable);
  return text && *text ? std::strtoul(text, nullptr, 10) : otherwise;
}

/// The current folder is this one, while it lives: what the monkey types as a folder's name is
/// made here.
class WorkingFolder {
 public:
  explicit WorkingFolder(const std::filesystem::path& folder)
      : before_(std::filesystem::current_path()) {
    std::filesystem::create_directories(folder);
    std::filesystem::current_path(folder);
  }
  ~WorkingFolder() { std::filesystem::current_path(before_); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  std::filesystem::path before_;
};

/// Good and bad, as somebody may drop them.
std::vector<std::filesystem::path> files_to_drop(const TempFolder& folder) {
  const auto text = [&](const std::string& name, const std::string& content) {
    write_bytes_to(folder / name, content);
    return folder / name;
  };
  ExrImage good(7, 3);
  good.add_radiance(RadianceImage(7, 3));
  write_exr(folder / "good.exr", good);
  mkfifo((folder / "pipe.xml").c_str(), 0600);
  mkfifo((folder / "pipe.exr").c_str(), 0600);
  return {
      text("small.xml", ball_scene(7, 3)),
      text("pixel.xml", ball_scene(1, 1)),
      text("line.xml", ball_scene(64, 1)),
      text("huge.xml", ball_scene(30000, 30000)),
      text("broken.xml", "<scene version=\"3.0.0\">"),
      text("empty.xml", ""),
      text("noise.exr", "not an EXR"),
      text("name\xff\x1b[31m.xml", "<nothing/>"),
      folder / "good.exr",
      folder / "pipe.xml",
      folder / "pipe.exr",
      folder / "missing.exr",
      folder.path(),
      "/dev/zero",
      "",
  };
}

class Monkey {
 public:
  Monkey(unsigned long seed, const TempFolder& folder)
      : random_(std::mt19937::result_type(seed)),
        files_(files_to_drop(folder)),
        offscreen_(64, 64),
        driver_(
            first_state(), offscreen_.gl(), [] {}, folder / "cache") {
    resize(1280, 720);
  }

  void act() {
    // What is tried more often stands more often.
    static constexpr std::array acts{
        &Monkey::move,         &Monkey::move,        &Monkey::point,      &Monkey::point,
        &Monkey::point,        &Monkey::click,       &Monkey::click,      &Monkey::click,
        &Monkey::double_click, &Monkey::drag_widget, &Monkey::press,      &Monkey::wheel,
        &Monkey::press_key,    &Monkey::press_key,   &Monkey::press_key,  &Monkey::repeat_key,
        &Monkey::type,         &Monkey::type,        &Monkey::drop,       &Monkey::change_size,
        &Monkey::change_size,  &Monkey::load_scene,  &Monkey::set_layout, &Monkey::set_scale,
        &Monkey::set_picture,  &Monkey::be_idle,
    };
    (this->*acts[below(acts.size())])();
    LabState& state = driver_.window().state();
    state.quit = false;
    // Not more work behind the window than is needed to have pictures.
    if (state.request.store.settings.width > 160 && state.request.store.settings.width < 4096) {
      state.request.store.settings.width = 40;
      state.request.store.settings.height = 30;
    }
    state.request.store.settings.max_depth = std::min(state.request.store.settings.max_depth, 4);
    state.reference_form.spp = std::min<std::uint64_t>(state.reference_form.spp, 64);
    if (state.playback.target() > 30) {
      state.playback.set_target(15);
    }
    frame();
  }

  void expect_sane() {
    const LabState& state = driver_.window().state();
    EXPECT_EQ(camera_fault(state.request.store.settings.camera), "");
    EXPECT_TRUE(!state.request.store.scene || (state.request.store.settings.width >= 1 &&
                                               state.request.store.settings.height >= 1));
    EXPECT_LE(std::abs(state.view.exposure), largest_exposure);
    EXPECT_GE(state.pan_zoom.zoom, 0.25f);
    EXPECT_TRUE(state.pan_zoom.center.x >= 0.0f && state.pan_zoom.center.x <= 1.0f);
    EXPECT_TRUE(state.pan_zoom.center.y >= 0.0f && state.pan_zoom.center.y <= 1.0f);
    EXPECT_TRUE(state.comparison.wipe_at >= 0.0f && state.comparison.wipe_at <= 1.0f);
    EXPECT_LT(state.comparison.lane, lane_count);
    EXPECT_LT(state.comparison.other, lane_count);
    EXPECT_NE(state.comparison.lane, state.comparison.other);
    ASSERT_EQ(state.request.lanes.settings.size(), lane_count);
    for (const LaneSettings& settings : state.request.lanes.settings) {
      for (int c = 0; c < estimator(settings.estimator).channels; ++c) {
        const float threshold = settings.thresholds[std::size_t(c)];
        EXPECT_TRUE(threshold > 0.0f && std::isfinite(threshold)) << threshold;
      }
      EXPECT_TRUE(std::isfinite(settings.policy.multiplier));
    }
    for (const auto& [name, box] : driver_.window().ui().widgets) {
      EXPECT_TRUE(std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.width) &&
                  std::isfinite(box.height))
          << name;
    }
  }

 private:
  static LabState first_state() {
    LabState state = initial_state();
    state.request.store.threads = 1;
    state.request.store.memory = std::size_t(16) << 20;
    return state;
  }

  std::size_t below(std::size_t count) { return random_() % count; }
  bool one_in(std::size_t count) { return below(count) == 0; }
  float between(float low, float high) {
    return low + (high - low) * float(below(10'001)) / 10'000.0f;
  }
  template <class Things>
  const auto& one_of(const Things& things) {
    return things[below(std::size(things))];
  }

  void frame() {
    ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
    seconds_ += 1.0 / 60.0;
    driver_.begin_frame(screen_, 1.0f);
    driver_.draw(seconds_);
    if (one_in(50)) {
      screen_.end_frame(offscreen_.gl(), offscreen_.width(), offscreen_.height());
    } else {
      ImGui::Render();
    }
  }

  void resize(int width, int height) {
    width_ = width;
    height_ = height;
    ImGui::GetIO().DisplaySize = {float(width), float(height)};
  }

  void go(float x, float y) {
    add_mouse_position(x, y);
    frame();
  }

  /// Anywhere, also where the window is not.
  void move() {
    if (one_in(20)) {
      go(-FLT_MAX, -FLT_MAX);
    } else if (one_in(20)) {
      go(between(-1e6f, 1e6f), between(-1e6f, 1e6f));
    } else {
      go(between(-5.0f, float(width_) + 5.0f), between(-5.0f, float(height_) + 5.0f));
    }
  }

  /// At a widget: what a hand does most.
  void point() {
    const auto& widgets = driver_.window().ui().widgets;
    if (widgets.empty()) {
      return;
    }
    const ScreenRect box =
        std::next(widgets.begin(), std::ptrdiff_t(below(widgets.size())))->second;
    go(box.x + between(0.0f, 1.0f) * box.width, box.y + between(0.0f, 1.0f) * box.height);
  }

  void button(int which, bool down) {
    add_mouse_button(which, down);
    frame();
  }

  void click() {
    point();
    button(0, true);
    button(0, false);
  }

  void double_click() {
    click();
    button(0, true);
    button(0, false);
  }

  void drag_widget() {
    point();
    const int which = int(below(2));
    button(which, true);
    const float x = ImGui::GetIO().MousePos.x;
    const float y = ImGui::GetIO().MousePos.y;
    const float far = one_in(5) ? 3000.0f : 60.0f;
    const float dx = between(-far, far);
    const float dy = between(-far, far);
    for (int i = 1; i <= 4; ++i) {
      go(x + dx * float(i) / 4.0f, y + dy * float(i) / 4.0f);
    }
    if (!one_in(10)) {
      button(which, false);
    }
  }

  /// A button, which may be held for long.
  void press() { button(int(below(3)), one_in(2)); }

  void wheel() {
    add_ctrl_key(one_in(3));
    add_mouse_wheel(one_in(10) ? between(-1e6f, 1e6f) : between(-3.0f, 3.0f));
    frame();
    add_ctrl_key(false);
  }

  void press_key() {
    const int key = one_of(key_table()).key;
    const bool shift = one_in(4);
    driver_.window().key({key, true, shift, one_in(20)});
    if (!one_in(4)) {
      driver_.window().key({key, false, shift, false});
    }
  }

  /// As of a key that is held for half a minute.
  void repeat_key() {
    const int key = one_of(key_table()).key;
    const bool shift = one_in(3);
    for (int i = 0; i < 300; ++i) {
      driver_.window().key({key, true, shift, false});
    }
    driver_.window().key({key, false, shift, false});
  }

  /// Without a slash: folders that are made are in the one of this test.
  void type() {
    static constexpr std::array<ImWchar, 24> characters{
        '0', '1', '7', '9', '9', '9', '9', '.', '-', 'e',  'E',   '+',
        'n', 'a', 'x', ' ', '%', '#', '@', 'q', '{', 0xE9, 0x42F, 0xFFFD};
    const std::size_t count = one_in(10) ? 400 : 1 + below(8);
    for (std::size_t i = 0; i < count; ++i) {
      ImGui::GetIO().AddInputCharacter(one_of(characters));
    }
    frame();
    if (one_in(2)) {
      add_enter_key(true);
      frame();
      add_enter_key(false);
    }
  }

  void drop() { driver_.drop(one_of(files_)); }

  void change_size() {
    static constexpr std::array<int, 14> sides{1,   2,   3,   8,   20,   40,   100,
                                               150, 200, 400, 720, 1100, 1920, 4000};
    resize(one_of(sides), one_of(sides));
  }

  void load_scene() {
    static const std::vector<std::string> names = builtin_scenes();
    if (one_in(2)) {
      driver_.load("synthetic:" + std::string(one_of(synthetics()).id));
    } else {
      driver_.load(one_of(names));
    }
  }

  void set_layout() { driver_.window().state().layout = one_of(layouts()).key; }

  void set_scale() {
    static constexpr std::array<float, 6> scales{0.0f, 0.5f, 0.75f, 1.0f, 2.0f, 3.0f};
    if (one_in(4)) {  // fonts take their time
      driver_.window().state().ui_scale = one_of(scales);
    }
  }

  /// One side of 30,000 would fit the memory, and take gigabytes of it: only both are refused.
  void set_picture() {
    static constexpr std::array<int, 7> sides{1, 2, 3, 4, 16, 60, 100};
    const int huge = one_in(10) ? 30'000 : 0;
    RenderSettings& settings = driver_.window().state().request.store.settings;
    settings.width = huge > 0 ? huge : one_of(sides);
    settings.height = huge > 0 ? huge : one_of(sides);
  }

  void be_idle() {
    for (int i = 0; i < 5; ++i) {
      usleep(2000);
      frame();
    }
  }

  std::mt19937 random_;
  std::vector<std::filesystem::path> files_;
  Offscreen offscreen_;
  ImguiScreen screen_;
  LabDriver driver_;
  int width_ = 0;
  int height_ = 0;
  double seconds_ = 0.0;
};

TEST(Monkey, FindsNothing) {
  const unsigned long seed = number_from("QUARTET_MONKEY_SEED", 1);
  const unsigned long events = number_from("QUARTET_MONKEY_EVENTS", 300);
  tell_of_deaths();
  const TempFolder folder;
  const WorkingFolder here(folder / "here");
  Monkey monkey(seed, folder);
  for (unsigned long event = 1; event <= events; ++event) {
    std::snprintf(where_it_is.data(), where_it_is.size(), "\nmonkey: seed %lu, event %lu\n", seed,
                  event);
    monkey.act();
    monkey.expect_sane();
    if (testing::Test::HasFailure()) {
      FAIL() << "seed " << seed << ", event " << event;
    }
  }
}

}  // namespace
}  // namespace quartet
