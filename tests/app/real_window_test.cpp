// The program in a real window: an X server without a screen, and xdotool as the hand. What the
// window did is read from the files that its own export writes.

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <thread>
#include <vector>

#include "tests/app/ball_scene.h"
#include "tests/files/temp_folder.h"
#include "tests/ui/lab_hand.h"

namespace quartet {
namespace {

using std::chrono::milliseconds;

constexpr int width = 1280;
constexpr int height = 800;

bool have(const std::string& tool) {
  return std::system(("command -v " + tool + " >/dev/null 2>&1").c_str()) == 0;
}

/// A program that is ended with this.
class Process {
 public:
  Process(const std::vector<std::string>& words, const std::filesystem::path& folder,
          const std::map<std::string, std::string>& environment, int keep_open = -1) {
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (const std::string& word : words) {
      argv.push_back(const_cast<char*>(word.c_str()));
    }
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      if (keep_open < 0 &&
          (chdir(folder.c_str()) != 0 || !freopen((folder / "log").c_str(), "w", stderr))) {
        _exit(126);
      }
      for (const auto& [name, value] : environment) {
        setenv(name.c_str(), value.c_str(), 1);
      }
      execvp(argv[0], argv.data());
      _exit(127);
    }
  }
  ~Process() {
    if (pid_ > 0 && !ended()) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool ended() {
    if (pid_ > 0 && waitpid(pid_, &status_, WNOHANG) == pid_) {
      pid_ = 0;
    }
    return pid_ <= 0;
  }
  void send(int signal) const { kill(pid_, signal); }
  int exit_code() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }

 private:
  pid_t pid_;
  int status_ = 0;
};

template <class Condition>
bool wait_for(Condition condition, std::chrono::seconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    std::this_thread::sleep_for(milliseconds(20));
  }
  return true;
}

/// What a command prints.
std::string output_of(const std::string& command) {
  std::string text;
  if (FILE* const pipe = popen((command + " 2>/dev/null").c_str(), "r")) {
    std::array<char, 256> buffer;
    while (fgets(buffer.data(), buffer.size(), pipe)) {
      text += buffer.data();
    }
    pclose(pipe);
  }
  return text;
}

/// Where things are: in a window of the same size and scene without a display.
std::map<std::string, ScreenRect> widgets_of_twin() {
  LabHand twin(width, height);
  twin.state().request.store.settings = default_settings(twin.state().trace_scene()->scene());
  twin.state().request.store.settings.width = 64;
  twin.state().request.store.settings.height = 64;
  twin.state().playback.set_target(15);
  twin.settle();
  auto widgets = twin.window().ui().widgets;
  twin.key('s');
  twin.frames(5);
  widgets["export.save"] = twin.rect("export.save");
  return widgets;
}

TEST(RealWindow, ADragAndAKeyArriveAndItCloses) {
  for (const char* tool : {"Xvfb", "xdotool"}) {
    if (!have(tool)) {
      GTEST_SKIP() << tool << " is missing";
    }
  }
  const TempFolder folder;
  write_bytes_to(folder / "ball.xml", ball_scene(64, 64));
  std::filesystem::create_directories(folder / "config/quartet");
  std::ofstream(folder / "config/quartet/settings.json")
      << "{\"width\": 4000, \"height\": 3000}";  // larger than the screen, which it then fills

  std::array<int, 2> pipe_ends;
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  Process server({"Xvfb", "-displayfd", std::to_string(pipe_ends[1]), "-screen", "0", "1280x800x24",
                  "-nolisten", "tcp"},
                 folder.path(), {}, pipe_ends[1]);
  close(pipe_ends[1]);
  std::array<char, 16> number{};
  const ssize_t length = read(pipe_ends[0], number.data(), number.size() - 1);
  close(pipe_ends[0]);
  ASSERT_GT(length, 0) << "Xvfb did not start";
  const std::string display = fmt::format(":{}", std::atoi(number.data()));
  const std::string hand = fmt::format("DISPLAY={} xdotool ", display);

  const std::map<std::string, ScreenRect> widgets = widgets_of_twin();
  // Without a look for leaks: what Mesa's driver leaves behind can be suppressed by no name,
  // because the driver has been unloaded by then.
  Process program({QUARTET_PROGRAM, (folder / "ball.xml").string(), "--ui-scale", "1"},
                  folder.path(),
                  {{"ASAN_OPTIONS", "detect_leaks=0"},
                   {"DISPLAY", display},
                   {"WAYLAND_DISPLAY", ""},
                   {"XDG_CONFIG_HOME", (folder / "config").string()}});
  std::string window;
  ASSERT_TRUE(wait_for(
      [&] {
        window = output_of(hand + "search --onlyvisible --name Quartet");
        return !window.empty() || program.ended();
      },
      std::chrono::seconds(30)));
  ASSERT_FALSE(program.ended()) << bytes_of(folder / "log");
  window = window.substr(0, window.find('\n'));
  const auto run = [&](const std::string& command) {
    EXPECT_EQ(std::system((hand + command).c_str()), 0) << command;
    std::this_thread::sleep_for(milliseconds(300));
  };
  const auto at = [](const ScreenRect& box) {
    return std::to_string(int(box.center_x())) + " " + std::to_string(int(box.center_y()));
  };
  run("windowmove " + window + " 0 0 windowfocus " + window);

  // A window that is shown may not have drawn yet, and what comes before its first picture is lost.
  std::this_thread::sleep_for(std::chrono::seconds(2));

  // The threshold of lane 2 to the right, by a slider, then half a stop by a key.
  const ScreenRect slider = widgets.at("lane1.threshold0");
  run("mousemove " + at(slider));
  run("mousedown 1");
  run("mousemove_relative 10 0");
  run("mousemove_relative 10 0");
  run("mouseup 1");
  run("key e");
  std::string command;
  // Until the picture is there the form does not save.
  ASSERT_TRUE(wait_for(
      [&] {
        run("key s");
        run("mousemove " + at(widgets.at("export.save")));
        run("mousedown 1");
        run("mouseup 1");
        // Escape would end an export that is under way, which takes a while under a sanitizer.
        const bool saved = wait_for(
            [&] {
              command = bytes_of(folder / "quartet-export/command.txt");
              return !command.empty();
            },
            std::chrono::seconds(15));
        if (!saved) {
          run("key Escape");
        }
        return saved;
      },
      std::chrono::seconds(120)));
  EXPECT_NE(command.find("--exposure=0.5"), std::string::npos) << command;
  const std::size_t lane = command.find("--lane kl:");
  ASSERT_NE(lane, std::string::npos) << command;
  EXPECT_GT(std::stof(command.substr(lane + 10)), 0.0052f) << command;
  EXPECT_NE(command.find("--lane chi2:0.007,"), std::string::npos) << command;

  // Endless passes, and the window is closed in the middle of them, as at the end of a session.
  program.send(SIGTERM);
  ASSERT_TRUE(wait_for([&] { return program.ended(); }, std::chrono::seconds(60)));
  EXPECT_EQ(program.exit_code(), 0) << bytes_of(folder / "log");
  EXPECT_NE(bytes_of(folder / "config/quartet/settings.json").find("\"exposure\": 0.5"),
            std::string::npos);
}

}  // namespace
}  // namespace quartet
