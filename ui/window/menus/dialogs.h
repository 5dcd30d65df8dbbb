#pragma once

#include "ui/window/lab_frame.h"

namespace quartet {

/// All keys and what the mouse does, over the window.
void draw_help(LabFrame& frame);

/// Where to and what to export.
void draw_export_form(LabFrame& frame);

}  // namespace quartet
