#pragma once

#include <GL/glcorearb.h>

namespace quartet {

/// The few functions of OpenGL 3.3 that are called here, fetched by name from whoever made the
/// context: no loader library, and no link against libOpenGL, which a plain machine lacks.
struct GlFunctions {
  PFNGLVIEWPORTPROC viewport;
  PFNGLCLEARCOLORPROC clear_color;
  PFNGLCLEARPROC clear;
  PFNGLGENTEXTURESPROC gen_textures;
  PFNGLDELETETEXTURESPROC delete_textures;
  PFNGLBINDTEXTUREPROC bind_texture;
  PFNGLTEXPARAMETERIPROC tex_parameter;
  PFNGLPIXELSTOREIPROC pixel_store;
  PFNGLTEXIMAGE2DPROC tex_image_2d;
  PFNGLTEXSUBIMAGE2DPROC tex_sub_image_2d;
  PFNGLGENFRAMEBUFFERSPROC gen_framebuffers;
  PFNGLBINDFRAMEBUFFERPROC bind_framebuffer;
  PFNGLFRAMEBUFFERTEXTURE2DPROC framebuffer_texture_2d;
  PFNGLCHECKFRAMEBUFFERSTATUSPROC check_framebuffer_status;
  PFNGLREADPIXELSPROC read_pixels;
  PFNGLFINISHPROC finish;
};

using GlFunction = void (*)();

/// `get` finds a function of the current context. Throws std::runtime_error that names one that is
/// missing.
GlFunctions load_gl(GlFunction (*get)(const char* name));

}  // namespace quartet
