#include "app/window/offscreen.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace quartet {

struct Offscreen::Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  GlFunctions gl{};

  ~Context() {
    if (display != EGL_NO_DISPLAY) {
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      if (context != EGL_NO_CONTEXT) {
        eglDestroyContext(display, context);
      }
      // The display is one for the whole process: another Offscreen may still use it.
    }
  }
};

namespace {

[[noreturn]] void fail(std::string_view what) {
  throw std::runtime_error(fmt::format(
      "cannot draw without a display: EGL {} (error {:#x}); the packages libegl1, libegl-mesa0, "
      "libgl1 and libgl1-mesa-dri are needed",
      what, eglGetError()));
}

}  // namespace

Offscreen::Offscreen(int width, int height)
    : width_(width), height_(height), context_(std::make_unique<Context>()) {
  const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (!get_display) {
    fail("has no eglGetPlatformDisplayEXT");
  }
  context_->display =
      get_display(EGL_PLATFORM_SURFACELESS_MESA, static_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
  if (context_->display == EGL_NO_DISPLAY || !eglInitialize(context_->display, nullptr, nullptr)) {
    fail("has no surfaceless platform");
  }
  if (!eglBindAPI(EGL_OPENGL_API)) {
    fail("has no OpenGL");
  }
  constexpr EGLint config_wishes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                      EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (!eglChooseConfig(context_->display, config_wishes, &config, 1, &configs) || configs == 0) {
    fail("has no configuration for OpenGL");
  }
  constexpr EGLint context_wishes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                       3,
                                       EGL_CONTEXT_MINOR_VERSION,
                                       3,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                       EGL_NONE};
  context_->context = eglCreateContext(context_->display, config, EGL_NO_CONTEXT, context_wishes);
  if (context_->context == EGL_NO_CONTEXT ||
      !eglMakeCurrent(context_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_->context)) {
    fail("gave no context of OpenGL 3.3");
  }
  context_->gl = load_gl([](const char* name) -> GlFunction { return eglGetProcAddress(name); });

  // The context owns these; they go with it. BGRA, as the pixels of a window lie: the software
  // rasteriser has faster ways for it.
  const GlFunctions& functions = context_->gl;
  GLuint texture = 0;
  functions.gen_textures(1, &texture);
  functions.bind_texture(GL_TEXTURE_2D, texture);
  functions.tex_image_2d(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_BGRA, GL_UNSIGNED_BYTE,
                         nullptr);
  GLuint framebuffer = 0;
  functions.gen_framebuffers(1, &framebuffer);
  functions.bind_framebuffer(GL_FRAMEBUFFER, framebuffer);
  functions.framebuffer_texture_2d(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  if (functions.check_framebuffer_status(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    fail(fmt::format("cannot draw a picture of {}x{}", width, height));
  }
}

Offscreen::~Offscreen() = default;

const GlFunctions& Offscreen::gl() const {
  return context_->gl;
}

DisplayImage Offscreen::read() const {
  DisplayImage image(width_, height_);
  const GlFunctions& functions = context_->gl;
  functions.pixel_store(GL_PACK_ALIGNMENT, 4);
  functions.read_pixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels().data());
  // OpenGL counts rows from below.
  for (int y = 0; y < height_ / 2; ++y) {
    for (int x = 0; x < width_; ++x) {
      std::swap(image.at(x, y), image.at(x, height_ - 1 - y));
    }
  }
  for (Rgba8& pixel : image.pixels()) {
    pixel.a = 255;
  }
  return image;
}

}  // namespace quartet
