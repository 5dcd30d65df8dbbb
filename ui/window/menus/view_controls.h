#pragma once

#include <string>

#include "ui/window/lab_frame.h"

namespace quartet {

/// The controls of the toolbar that change how lanes are shown and nothing of what is computed.
/// Each is drawn at the cursor, `width` pixels wide.
void draw_exposure(LabFrame& frame, float width);
void draw_tone_map(LabFrame& frame, float width);
void draw_heat(LabFrame& frame, float width);
void draw_layout(LabFrame& frame, float width);

/// What the controls say of a setting.
std::string heat_label(HeatRange heat);

}  // namespace quartet
