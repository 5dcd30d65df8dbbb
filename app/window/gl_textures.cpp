#include "app/window/gl_textures.h"

namespace quartet {

GlTextures::~GlTextures() {
  for (const Texture& texture : textures_) {
    gl_.delete_textures(1, &texture.name);
  }
}

std::uintptr_t GlTextures::upload(std::size_t slot, const DisplayImage& image) {
  if (slot >= textures_.size()) {
    textures_.resize(slot + 1);
  }
  Texture& texture = textures_[slot];
  if (texture.name == 0) {
    gl_.gen_textures(1, &texture.name);
  }
  gl_.bind_texture(GL_TEXTURE_2D, texture.name);
  gl_.pixel_store(GL_UNPACK_ALIGNMENT, 4);
  gl_.pixel_store(GL_UNPACK_ROW_LENGTH, 0);
  const void* pixels = image.pixels().data();
  if (texture.width == image.width() && texture.height == image.height()) {
    gl_.tex_sub_image_2d(GL_TEXTURE_2D, 0, 0, 0, image.width(), image.height(), GL_RGBA,
                         GL_UNSIGNED_BYTE, pixels);
  } else {
    gl_.tex_image_2d(GL_TEXTURE_2D, 0, GL_RGBA8, image.width(), image.height(), 0, GL_RGBA,
                     GL_UNSIGNED_BYTE, pixels);
    gl_.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    texture.width = image.width();
    texture.height = image.height();
  }
  return texture.name;
}

}  // namespace quartet
