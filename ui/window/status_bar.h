#pragma once

#include "ui/window/lab_frame.h"

namespace quartet {

float status_bar_height(const Ui& ui);
/// What the renderer is doing and what it holds; or the last message.
void draw_status_bar(LabFrame& frame, const ScreenRect& box);

/// "tracing pass 7 of 15 · 2.6 M samples/s · ..."
std::string status_text(const SessionStatus& status, bool loading, bool saving);

}  // namespace quartet
