#pragma once

#include <memory>

#include "app/window/gl_functions.h"
#include "renderer/base/image.h"

namespace quartet {

/// An OpenGL context with a picture to draw into and no display: EGL on Mesa's surfaceless
/// platform, which needs neither X nor any variable of the environment. Current on the thread that
/// made it.
class Offscreen {
 public:
  /// Throws std::runtime_error that says what is missing.
  Offscreen(int width, int height);
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  const GlFunctions& gl() const;
  /// What was drawn so far, opaque.
  DisplayImage read() const;

 private:
  struct Context;
  int width_, height_;
  std::unique_ptr<Context> context_;
};

}  // namespace quartet
