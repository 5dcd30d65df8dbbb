#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/window/gl_functions.h"
#include "app/window/window_size.h"
#include "ui/window/keys.h"

namespace quartet {

/// There is nothing to open a window on. what() says why.
struct NoDisplay : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a window does with what happens to it.
struct WindowHandlers {
  std::function<void(const KeyEvent&)> key;
  std::function<void(const std::string& path)> drop;
  /// Draws a frame; returns whether time passes in it, so that it is to be drawn again soon.
  std::function<bool(double seconds)> draw;
  std::function<bool()> wants_to_close;
};

/// A window on the display, with an OpenGL context that is current on the thread that made it. One
/// at a time.
class Window {
 public:
  /// Of that size at scale 1, times the scale of the display, or of what room the screen has.
  /// Throws NoDisplay.
  Window(const std::string& title, const WindowSize& wanted);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  const GlFunctions& gl() const;
  float monitor_scale() const;
  /// To open another one alike.
  WindowSize size_at_scale_one() const;
  void framebuffer_size(int& width, int& height) const;

  /// Connects ImGui, whose context must be current, with this window's input, for as long as what
  /// is returned lives: less long than the context.
  [[nodiscard]] std::shared_ptr<void> attach_imgui(WindowHandlers handlers);
  void begin_imgui_frame();

  /// Draws on input, on wake() and while a frame asks for it, not otherwise; until it is closed.
  void run();

  /// From any thread: there is something new to draw.
  void wake();
  void swap();
  /// It is seen no more.
  void hide();

  struct Native;

 private:
  std::unique_ptr<Native> native_;
};

}  // namespace quartet
