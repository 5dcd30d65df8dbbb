#pragma once

#include <vector>

#include "renderer/image/views.h"
#include "ui/lab_frame.h"

namespace quartet {

/// The pictures of the window, drawn again only when what they show has changed.
class PictureCache {
 public:
  explicit PictureCache(UploadTexture upload) : upload_(std::move(upload)) {}

  struct Picture {
    View view;  ///< its pixels are those of the texture
    std::uintptr_t texture = 0;
  };

  /// A lane as its slot wants it, in a texture slot. Null before the first snapshot.
  const Picture* get(std::size_t texture_slot, const LabFrame& frame, std::size_t lane,
                     const SlotChoice& choice);

 private:
  struct Entry {
    std::uint64_t snapshot = 0;
    std::size_t lane = 0;
    SlotChoice choice;
    ViewSettings settings;
    bool drawn = false;
    Picture picture;
  };

  UploadTexture upload_;
  std::vector<Entry> entries_;
};

}  // namespace quartet
