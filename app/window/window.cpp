#include "app/window/window.h"

#include <backends/imgui_impl_glfw.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <optional>

#include "ui/window/keyboard.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace quartet {

struct Window::Native {
  GLFWwindow* window = nullptr;
  GlFunctions gl{};
  WindowHandlers handlers;
  std::atomic<bool> woken = true;
  bool input = true;
  Keyboard keyboard;
};

namespace {

// A frame shows the input before it; widgets that appear take one or two more to settle.
constexpr int frames_after_input = 3;
constexpr double shortest_frame = 1.0 / 60.0;

std::string last_error;

void remember_error(int, const char* text) {
  last_error = text;
}

bool is_set(const char* variable) {
  const char* const value = std::getenv(variable);
  return value && *value;
}

Window::Native& native_of(GLFWwindow* window) {
  return *static_cast<Window::Native*>(glfwGetWindowUserPointer(window));
}

int special_key(int key) {
  switch (key) {
    case GLFW_KEY_ESCAPE:
      return key_escape;
    case GLFW_KEY_ENTER:
      return key_enter;
    case GLFW_KEY_TAB:
      return key_tab;
    case GLFW_KEY_LEFT:
      return key_left;
    case GLFW_KEY_RIGHT:
      return key_right;
    case GLFW_KEY_UP:
      return key_up;
    case GLFW_KEY_DOWN:
      return key_down;
    case GLFW_KEY_PAGE_UP:
      return key_page_up;
    case GLFW_KEY_PAGE_DOWN:
      return key_page_down;
    case GLFW_KEY_HOME:
      return key_home;
    case GLFW_KEY_END:
      return key_end;
    case GLFW_KEY_SPACE:
      return ' ';
    default:
      return 0;
  }
}

/// What stands there on a US keyboard: GLFW names places by it.
int place_of(int key) {
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) {
    return 'a' + (key - GLFW_KEY_A);
  }
  const bool known =
      (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) || key == GLFW_KEY_COMMA || key == GLFW_KEY_PERIOD;
  return known ? key : 0;
}

void pass_on(Window::Native& native, const std::optional<KeyEvent>& event) {
  // While a text is typed keys belong to it; but one that was held must still come up.
  const bool typing = ImGui::GetIO().WantTextInput;
  if (event && (!typing || !event->down) && native.handlers.key) {
    native.handlers.key(*event);
  }
}

void on_key(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
  Window::Native& native = native_of(window);
  native.input = true;
  if (action == GLFW_RELEASE) {
    pass_on(native, native.keyboard.up(scancode));
    return;
  }
  if ((modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0) {
    return;  // commands to somebody else
  }
  const bool shift = (modifiers & GLFW_MOD_SHIFT) != 0;
  if (const int special = special_key(key)) {
    pass_on(native, native.keyboard.down_as(scancode, special, shift));
  } else {
    native.keyboard.down(scancode, place_of(key), shift);
  }
}

/// What the key gives that went down just before.
void on_char(GLFWwindow* window, unsigned character) {
  Window::Native& native = native_of(window);
  native.input = true;
  pass_on(native, native.keyboard.gave(character));
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
  Window::Native& native = native_of(window);
  native.input = true;
  if (count > 0 && native.handlers.drop) {
    native.handlers.drop(paths[0]);
  }
}

/// Units of the window's size for one of a display at scale 1. Where such units are scaled by the
/// system (Wayland) it is 1, whatever the text's scale.
float size_scale(GLFWwindow* window) {
  float x = 1.0f;
  float y = 1.0f;
  glfwGetWindowContentScale(window, &x, &y);
  int width = 0;
  int pixels = 0;
  int ignored = 0;
  glfwGetWindowSize(window, &width, &ignored);
  glfwGetFramebufferSize(window, &pixels, &ignored);
  const float scale = std::max(x, y);
  return std::max(1.0f, pixels > 0 ? scale * float(width) / float(pixels) : scale);
}

/// What the screen has room for beside panels, less the frame that the window gets.
WindowSize room_on_screen(GLFWwindow* window) {
  GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
  if (!monitor) {
    return {};
  }
  int x = 0;
  int y = 0;
  WindowSize area;
  glfwGetMonitorWorkarea(monitor, &x, &y, &area.width, &area.height);
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
  glfwGetWindowFrameSize(window, &left, &top, &right, &bottom);
  return {std::max(0, area.width - left - right), std::max(0, area.height - top - bottom)};
}

void fit_to_screen(GLFWwindow* window, const WindowSize& wanted) {
  const WindowSize room = room_on_screen(window);
  const WindowSize size = fitting_window(wanted, size_scale(window), room);
  const auto least = [](int usual, int most) { return most > 0 ? std::min(usual, most) : usual; };
  glfwSetWindowSizeLimits(window, least(960, room.width), least(600, room.height), GLFW_DONT_CARE,
                          GLFW_DONT_CARE);
  glfwSetWindowSize(window, size.width, size.height);
}

template <class... Arguments>
void on_input(GLFWwindow* window, Arguments...) {
  native_of(window).input = true;
}

}  // namespace

Window::Window(const std::string& title, const WindowSize& wanted)
    : native_(std::make_unique<Native>()) {
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) {
    throw NoDisplay("there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set)");
  }
  glfwSetErrorCallback(remember_error);
  if (!glfwInit()) {
    throw NoDisplay(fmt::format("the display cannot be used ({})", last_error));
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);  // until its size is right
  native_->window = glfwCreateWindow(wanted.width, wanted.height, title.c_str(), nullptr, nullptr);
  if (!native_->window) {
    glfwTerminate();
    throw NoDisplay(fmt::format("the display has no OpenGL 3.3 ({})", last_error));
  }
  glfwMakeContextCurrent(native_->window);
  glfwSwapInterval(1);
  try {
    native_->gl = load_gl([](const char* name) -> GlFunction { return glfwGetProcAddress(name); });
  } catch (const std::runtime_error& error) {
    glfwDestroyWindow(native_->window);
    glfwTerminate();
    throw NoDisplay(error.what());
  }
  glfwSetWindowUserPointer(native_->window, native_.get());
  fit_to_screen(native_->window, wanted);
  glfwShowWindow(native_->window);
}

Window::~Window() {
  glfwDestroyWindow(native_->window);
  glfwTerminate();
}

const GlFunctions& Window::gl() const {
  return native_->gl;
}

float Window::monitor_scale() const {
  float x = 1.0f;
  float y = 1.0f;
  glfwGetWindowContentScale(native_->window, &x, &y);
  return std::max(1.0f, std::max(x, y));
}

WindowSize Window::size_at_scale_one() const {
  WindowSize size;
  glfwGetWindowSize(native_->window, &size.width, &size.height);
  return remembered_window(size, size_scale(native_->window));
}

void Window::framebuffer_size(int& width, int& height) const {
  glfwGetFramebufferSize(native_->window, &width, &height);
}

std::shared_ptr<void> Window::attach_imgui(WindowHandlers handlers) {
  native_->handlers = std::move(handlers);
  GLFWwindow* const window = native_->window;
  // ImGui's own callbacks call these first.
  glfwSetKeyCallback(window, on_key);
  glfwSetCharCallback(window, on_char);
  glfwSetDropCallback(window, on_drop);
  glfwSetCursorPosCallback(window, on_input<double, double>);
  glfwSetMouseButtonCallback(window, on_input<int, int, int>);
  glfwSetScrollCallback(window, on_input<double, double>);
  glfwSetFramebufferSizeCallback(window, on_input<int, int>);
  glfwSetWindowRefreshCallback(window, on_input<>);
  glfwSetWindowFocusCallback(window, on_input<int>);
  glfwSetCursorEnterCallback(window, on_input<int>);
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  return {native_.get(), [](Native* native) {
            ImGui_ImplGlfw_Shutdown();
            native->handlers = {};
          }};
}

void Window::begin_imgui_frame() {
  ImGui_ImplGlfw_NewFrame();
}

void Window::swap() {
  glfwSwapBuffers(native_->window);
}

void Window::hide() {
  glfwHideWindow(native_->window);
  glfwPollEvents();
}

void Window::wake() {
  native_->woken = true;
  glfwPostEmptyEvent();
}

void Window::run() {
  int frames = frames_after_input;
  bool animate = false;
  double drawn = -1.0;
  const auto closing = [&] {
    return glfwWindowShouldClose(native_->window) || native_->handlers.wants_to_close();
  };
  while (!closing()) {
    const bool typing = ImGui::GetIO().WantTextInput;  // its cursor blinks
    const double wait = frames > 0 ? 0.0 : animate ? 0.03 : typing ? 0.25 : 60.0;
    const double rest = drawn + shortest_frame - glfwGetTime();
    glfwWaitEventsTimeout(std::max({wait, rest, 1e-4}));
    const bool woken = native_->woken.exchange(false);
    if (native_->input) {
      native_->input = false;
      frames = frames_after_input;
    } else if (woken || animate || typing) {
      frames = std::max(frames, 1);
    }
    if (frames == 0 || glfwGetTime() < drawn + 0.9 * shortest_frame || closing()) {
      continue;
    }
    --frames;
    drawn = glfwGetTime();
    animate = native_->handlers.draw(drawn);
  }
}

}  // namespace quartet
