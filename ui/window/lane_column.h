#pragma once

#include "ui/window/lab_frame.h"
#include "ui/window/lab_layout.h"

namespace quartet {

/// What all columns give to keys and pictures, so that they stay level.
ColumnWish column_wish(const LabFrame& frame);

/// A lane with all its parts, each where the layout says.
void draw_lane_column(LabFrame& frame, std::size_t lane, const ColumnLayout& layout);

}  // namespace quartet
