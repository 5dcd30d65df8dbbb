#pragma once

#include "ui/window/pictures/picture_slot.h"

namespace quartet {

/// The key to a picture's colours, below it.
void draw_color_key(LabFrame& frame, const PictureSlot& slot, const ScreenRect& box);

/// Height that a key needs; 0 for a view without colours to explain.
float color_key_height(const Ui& ui, ViewKind kind);

}  // namespace quartet
