#pragma once

#include <optional>

#include "ui/window/pictures/picture_slot.h"

namespace quartet {

/// The pixel whose numbers are read out: the one under the mouse, else the pinned one; none where
/// the pictures do not reach so far.
std::optional<glm::ivec2> read_out_pixel(const LabState& state, const Snapshot* snapshot);

/// The pixel's numbers in the slot's lane, on the lower edge of the slot.
void draw_read_out(LabFrame& frame, const PictureSlot& slot, glm::ivec2 pixel);

/// The numbers of both lanes of a wipe, a line each.
void draw_wipe_read_out(LabFrame& frame, const PictureSlot& a, const PictureSlot& b,
                        glm::ivec2 pixel);

}  // namespace quartet
