#pragma once

#include "ui/window/lab_frame.h"

namespace quartet {

/// The controls that all lanes share. They take as many rows as the window's width makes them.
float toolbar_height(const LabFrame& frame, float width);
void draw_toolbar(LabFrame& frame, const ScreenRect& box);

}  // namespace quartet
