#pragma once

#include "app/window/gl_functions.h"

struct ImGuiContext;

namespace quartet {

/// Dear ImGui on the current OpenGL context. One at a time is current; it never writes an ini file.
class ImguiScreen {
 public:
  ImguiScreen();
  ~ImguiScreen();
  ImguiScreen(const ImguiScreen&) = delete;
  ImguiScreen& operator=(const ImguiScreen&) = delete;

  /// Fonts were made anew: before the next frame.
  void forget_fonts();
  /// Begins a frame; ImGui's display size and time step are set already.
  void begin_frame();
  /// Draws what was asked for since begin_frame on a cleared ground of width × height pixels.
  void end_frame(const GlFunctions& gl, int width, int height);

 private:
  ImGuiContext* context_;
};

}  // namespace quartet
