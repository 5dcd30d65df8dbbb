#pragma once

#include "ui/window/lab_frame.h"

namespace quartet {

/// How much of `area`, in which lanes and dock lie, the dock takes: its bar alone when it is
/// folded. Open, it leaves the lanes at least half.
float dock_height(const LabFrame& frame, const ScreenRect& area);

bool dock_is_open(const LabFrame& frame, const ScreenRect& area);

/// Bar, chart and table of the errors against the reference. `area` as above.
void draw_dock(LabFrame& frame, const ScreenRect& area, const ScreenRect& box);

}  // namespace quartet
