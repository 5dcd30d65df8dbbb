#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "ui/widgets/theme.h"

namespace quartet {

/// The window's own widgets. Each is placed with ImGui's cursor, is recorded in the Ui under its
/// name, edits what it is given, and returns whether it changed it.

struct SliderRange {
  float low = 0.0f;
  float high = 1.0f;
  bool logarithmic = false;
};

/// What nothing draws, but the mouse can press. At least one pixel wide and high: of none ImGui
/// makes nothing, and in a window that is too small for all there is a lot without room.
bool invisible_button(const std::string& name, ImVec2 size, ImGuiButtonFlags flags = 0);

/// A thin line with a knob; a click anywhere on it jumps there.
bool slider(Ui& ui, const std::string& name, float& value, const SliderRange& range, float width,
            ImU32 color);

/// The number beside a slider: drag it, or double-click and type. `low` and `high` bound what is
/// typed, and may be wider than the slider.
bool number_field(Ui& ui, const std::string& name, float& value, float low, float high,
                  const char* format, float width);

enum class Icon { to_start, back, pause, play, forward, restart, reset, fold, unfold };

bool icon_button(Ui& ui, const std::string& name, Icon icon, bool enabled = true,
                 float width = 0.0f);

/// A combo box; `rows` draws what opens, with ImGui::Selectable, and returns whether it changed
/// anything.
bool combo(Ui& ui, const std::string& name, const std::string& shown, float width,
           const std::function<bool()>& rows);

/// The width of a combo box that shows this label.
float combo_width(const Ui& ui, std::string_view label);

/// A row of a combo box; returns whether it was chosen.
bool combo_row(Ui& ui, const std::string& name, const std::string& label, bool chosen,
               const std::string& tooltip = "");

/// Of the last item, wrapped; not while it is held, as it would lie over the number that changes.
void tooltip(const Ui& ui, const std::string& text);

/// Dim text before a control, level with what stands in it; moves the cursor past it and returns by
/// how much.
float leading_label(const Ui& ui, const std::string& text);

/// The first of the texts that is no wider than `width`; the last where none is.
std::string fitting_text(ImFont* font, const std::vector<std::string>& texts, float width);
float text_width(ImFont* font, const std::string& text);

/// Text at a place, without an item.
void text_at(ImFont* font, float x, float y, ImU32 color, const std::string& text);
/// The same, ending at x.
void text_left_of(ImFont* font, float x, float y, ImU32 color, const std::string& text);
/// Text on a dark strip, over a picture; returns the strip.
ScreenRect badge(const Ui& ui, float x, float y, ImU32 color, const std::string& text);

}  // namespace quartet
