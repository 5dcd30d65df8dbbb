#pragma once

#include <cstdint>
#include <vector>

#include "app/window/gl_functions.h"
#include "renderer/base/image.h"

namespace quartet {

/// The pictures of the window as textures: one a slot, made when it is first used.
class GlTextures {
 public:
  /// The context must be current now and in every call.
  explicit GlTextures(const GlFunctions& gl) : gl_(gl) {}
  ~GlTextures();
  GlTextures(const GlTextures&) = delete;
  GlTextures& operator=(const GlTextures&) = delete;

  /// Makes the image that of the slot and returns the texture's handle. Nothing is filtered: drawn
  /// larger, its pixels are squares.
  std::uintptr_t upload(std::size_t slot, const DisplayImage& image);

 private:
  struct Texture {
    GLuint name = 0;
    int width = 0, height = 0;
  };

  const GlFunctions& gl_;
  std::vector<Texture> textures_;
};

}  // namespace quartet
