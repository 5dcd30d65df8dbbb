#pragma once

#include "ui/window/lab_frame.h"

namespace quartet {

/// A picture with its controls: a combo box for what it shows, pan and zoom, the pixel under the
/// mouse, the numbers in the pixels, the camera.
struct PictureSlot {
  std::size_t lane;     ///< whose column it is
  std::size_t slot;     ///< which of the lane's two
  std::size_t source;   ///< whose pixels are shown
  std::size_t texture;  ///< of the cache
  ScreenRect box;
  bool read_out = false;  ///< says the numbers of the pixel under the mouse
};

/// Under which the window records it.
std::string slot_name(const PictureSlot& slot);

/// What is drawn in the slot now: while a key is held, the reference in the place of the image.
SlotChoice shown_choice(const LabState& state, const PictureSlot& slot);

void draw_picture_slot(LabFrame& frame, const PictureSlot& slot);

/// A and B of the comparison in one slot, with a line between them that can be dragged.
void draw_wipe_slot(LabFrame& frame, const PictureSlot& a, const PictureSlot& b);

}  // namespace quartet
