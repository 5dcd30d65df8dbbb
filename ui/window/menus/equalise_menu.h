#pragma once

#include "ui/window/lab_frame.h"

namespace quartet {

/// The button that gives all lanes the same samples, seconds or error, its menu, and how far it has
/// come. Ends at `right`; returns where it begins.
float draw_equalise_menu(LabFrame& frame, const ScreenRect& bar, float right);

}  // namespace quartet
