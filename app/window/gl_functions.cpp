#include "app/window/gl_functions.h"

#include <fmt/format.h>

#include <stdexcept>

namespace quartet {
namespace {

template <class Function>
void load(Function& function, GlFunction (*get)(const char*), const char* name) {
  function = reinterpret_cast<Function>(get(name));
  if (!function) {
    throw std::runtime_error(fmt::format("this OpenGL has no {}; 3.3 or newer is needed", name));
  }
}

}  // namespace

GlFunctions load_gl(GlFunction (*get)(const char* name)) {
  GlFunctions gl{};
  load(gl.viewport, get, "glViewport");
  load(gl.clear_color, get, "glClearColor");
  load(gl.clear, get, "glClear");
  load(gl.gen_textures, get, "glGenTextures");
  load(gl.delete_textures, get, "glDeleteTextures");
  load(gl.bind_texture, get, "glBindTexture");
  load(gl.tex_parameter, get, "glTexParameteri");
  load(gl.pixel_store, get, "glPixelStorei");
  load(gl.tex_image_2d, get, "glTexImage2D");
  load(gl.tex_sub_image_2d, get, "glTexSubImage2D");
  load(gl.gen_framebuffers, get, "glGenFramebuffers");
  load(gl.bind_framebuffer, get, "glBindFramebuffer");
  load(gl.framebuffer_texture_2d, get, "glFramebufferTexture2D");
  load(gl.check_framebuffer_status, get, "glCheckFramebufferStatus");
  load(gl.read_pixels, get, "glReadPixels");
  load(gl.finish, get, "glFinish");
  return gl;
}

}  // namespace quartet
