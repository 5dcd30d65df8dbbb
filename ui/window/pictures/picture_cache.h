#pragma once

#include <vector>

#include "renderer/view/views.h"
#include "ui/window/lab_frame.h"

namespace quartet {

/// The pictures of the window, drawn again only when what they show has changed.
class PictureCache {
 public:
  explicit PictureCache(UploadTexture upload) : upload_(std::move(upload)) {}

  /// A lane as its slot wants it, kept under the number of a texture slot. Null before the first
  /// snapshot.
  const View* get(std::size_t texture_slot, const LabFrame& frame, std::size_t lane,
                  const SlotChoice& choice);

  /// What get() drew last in the slot, which must have pixels, as a texture to be drawn over `size`
  /// pixels of the screen. Where that is larger, the picture's pixels stay squares; where it is
  /// smaller, they are averaged, here and once: filtered at every drawing they would be a third of
  /// a frame's cost where no graphics card draws.
  std::uintptr_t texture(std::size_t texture_slot, glm::ivec2 size);

 private:
  struct Entry {
    std::uint64_t snapshot = 0;
    std::size_t lane = 0;
    SlotChoice choice;
    ViewSettings settings;
    bool drawn = false;
    View view;
    glm::ivec2 uploaded{0};  // size of the texture; 0 while it shows another view
    std::uintptr_t texture = 0;
  };

  UploadTexture upload_;
  std::vector<Entry> entries_;
};

}  // namespace quartet
