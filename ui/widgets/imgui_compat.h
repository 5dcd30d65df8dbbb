#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <cstdint>

namespace quartet {

/// What differs between Dear ImGui 1.86 (Debian 12) and its successors. Input here is only what no
/// backend brings, as in tests; a window's backend does its own. Keys of ours do not go this way:
/// see keys.h.

inline void add_mouse_position(float x, float y) {
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddMousePosEvent(x, y);
#else
  ImGui::GetIO().MousePos = ImVec2(x, y);
#endif
}

inline void add_mouse_button(int button, bool down) {
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddMouseButtonEvent(button, down);
#else
  ImGui::GetIO().MouseDown[button] = down;
#endif
}

inline void add_mouse_wheel(float notches) {
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddMouseWheelEvent(0.0f, notches);
#else
  ImGui::GetIO().MouseWheel += notches;
#endif
}

inline void add_enter_key(bool down) {
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddKeyEvent(ImGuiKey_Enter, down);
#else
  constexpr int code = 13;  // any number, as long as it is the same in both
  ImGui::GetIO().KeyMap[ImGuiKey_Enter] = code;
  ImGui::GetIO().KeysDown[code] = down;
#endif
}

inline void add_ctrl_key(bool down) {
#if IMGUI_VERSION_NUM >= 18900
  ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, down);
#elif IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddKeyEvent(ImGuiKey_ModCtrl, down);
#else
  ImGui::GetIO().KeyCtrl = down;
#endif
}

inline float font_size(const ImFont* font) {
#if IMGUI_VERSION_NUM >= 19200
  return font->LegacySize;
#else
  return font->FontSize;
#endif
}

/// Whether the font itself has a sign for this character.
inline bool has_glyph(ImFont* font, ImWchar character) {
#if IMGUI_VERSION_NUM >= 19200
  return font->IsGlyphInFont(character);
#else
  return font->FindGlyphNoFallback(character) != nullptr;
#endif
}

inline ImTextureID texture_id(std::uintptr_t handle) {
  // A pointer up to 1.91, a number later; only one cast does both.
  return (ImTextureID)(std::intptr_t)handle;  // NOLINT(performance-no-int-to-ptr)
}

/// To be called after each NewFrame, which fills the table. A corner of almost no radius is looked
/// up as a circle of radius 0, whose number of pieces is 0, and Dear ImGui divides by it: a widget
/// that is a hair wider than two pixels ended the program.
inline void give_tiny_corners_pieces() {
  ImGui::GetDrawListSharedData()->CircleSegmentCounts[0] = IM_DRAWLIST_CIRCLE_AUTO_SEGMENT_MIN;
}

}  // namespace quartet
