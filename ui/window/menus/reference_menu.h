#pragma once

#include <string>

#include "ui/window/lab_frame.h"

namespace quartet {

/// What there is of a reference, and the menu to compute or load one, in the dock's bar.
void draw_reference_menu(LabFrame& frame, const ScreenRect& box);

/// In the place of chart and table while there is no reference.
void draw_missing_reference(LabFrame& frame, const ScreenRect& box);

/// "1024 spp · noise floor 2.1e-05", "computing 130 of 1024 spp, 40 s left"; from the longest to
/// the shortest.
std::vector<std::string> reference_texts(const LabFrame& frame);

}  // namespace quartet
