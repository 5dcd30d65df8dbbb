#pragma once

#include "ui/window/lab_frame.h"

namespace quartet {

/// The combo box of scenes, at the cursor: those that come with the program, the cases that methods
/// fail on, sources that stand in for tracing, and any file.
void draw_scene(LabFrame& frame, float width);

/// What the combo box says.
std::string scene_label(const LabState& state);

/// Once the scene of a failure case is there: the view and zoom that show what goes wrong, and what
/// to look at.
void show_failure(LabState& state, const FailureCase& failure);

}  // namespace quartet
