#include "ui/widgets/theme.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "renderer/view/estimator_look.h"

namespace quartet {
namespace {

// Latin, Greek, punctuation, superscripts, arrows, mathematics, shapes: 1.86 bakes what it is told.
constexpr ImWchar glyph_ranges[] = {0x0020, 0x00FF, 0x0391, 0x03C9, 0x2010, 0x2027,
                                    0x2030, 0x203A, 0x2070, 0x208E, 0x2190, 0x2199,
                                    0x2200, 0x2265, 0x25A0, 0x25CF, 0};

ImFont* add_font(const std::filesystem::path& inter, const std::filesystem::path& dejavu,
                 float size) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.PixelSnapH = true;
  ImFont* font = nullptr;
  std::error_code ignored;
  if (std::filesystem::exists(inter, ignored)) {
    font = atlas.AddFontFromFileTTF(inter.c_str(), size, &config, glyph_ranges);
  }
  if (std::filesystem::exists(dejavu, ignored)) {
    // Behind Inter it lends the signs that Inter lacks.
    config.MergeMode = font != nullptr;
    ImFont* const fallback = atlas.AddFontFromFileTTF(dejavu.c_str(), size, &config, glyph_ranges);
    font = font ? font : fallback;
  }
  return font ? font : atlas.AddFontDefault();
}

ImVec4 vec4(ImU32 color) {
  return ImGui::ColorConvertU32ToFloat4(color);
}

}  // namespace

ImU32 estimator_color(EstimatorId estimator) {
  const Rgba8 color = look_of(estimator).screen;
  return IM_COL32(color.r, color.g, color.b, 255);
}

ImU32 with_alpha(ImU32 color, float alpha) {
  return (color & ~IM_COL32_A_MASK) | (ImU32(alpha * 255.0f + 0.5f) << IM_COL32_A_SHIFT);
}

void Ui::mark(const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  widgets[name] = {low.x, low.y, high.x - low.x, high.y - low.y};
  if (ImGui::IsItemActive()) {
    held = name;
  }
}

void set_theme(Ui& ui, float scale, const FontFolders& folders) {
  ui.scale = scale;
  const auto add = [&](const char* inter, const char* dejavu, float size) {
    return add_font(folders.inter / inter, folders.dejavu / dejavu, std::round(size * scale));
  };
  ImGui::GetIO().Fonts->Clear();
  ui.body = add("Inter-Regular.otf", "DejaVuSans.ttf", 14.0f);
  ui.bold = add("Inter-SemiBold.otf", "DejaVuSans-Bold.ttf", 15.0f);
  ui.small = add("Inter-Regular.otf", "DejaVuSans.ttf", 12.0f);

  ImGui::GetStyle() = ImGuiStyle();
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowPadding = {10, 8};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.FrameRounding = 5;
  style.PopupRounding = 6;
  style.GrabRounding = 5;
  style.ScrollbarRounding = 6;
  style.ScrollbarSize = 12;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.ScaleAllSizes(scale);
  const ImU32 frame = IM_COL32(36, 40, 50, 255);
  const ImU32 hovered = IM_COL32(48, 54, 67, 255);
  const ImU32 active = IM_COL32(58, 66, 82, 255);
  const auto set = [&](ImGuiCol color, ImU32 value) { style.Colors[color] = vec4(value); };
  set(ImGuiCol_Text, palette::text);
  set(ImGuiCol_TextDisabled, palette::dim);
  set(ImGuiCol_WindowBg, palette::panel);
  set(ImGuiCol_ChildBg, 0);
  set(ImGuiCol_PopupBg, IM_COL32(29, 33, 41, 252));
  set(ImGuiCol_Border, palette::line);
  set(ImGuiCol_FrameBg, frame);
  set(ImGuiCol_FrameBgHovered, hovered);
  set(ImGuiCol_FrameBgActive, active);
  set(ImGuiCol_Button, frame);
  set(ImGuiCol_ButtonHovered, hovered);
  set(ImGuiCol_ButtonActive, active);
  set(ImGuiCol_Header, hovered);
  set(ImGuiCol_HeaderHovered, hovered);
  set(ImGuiCol_HeaderActive, active);
  set(ImGuiCol_CheckMark, palette::check);
  set(ImGuiCol_Separator, palette::line);
  set(ImGuiCol_TextSelectedBg, IM_COL32(60, 110, 180, 200));
  set(ImGuiCol_ModalWindowDimBg, IM_COL32(0, 0, 0, 120));
  set(ImGuiCol_NavHighlight, 0);
}

float natural_scale(int width, int height) {
  const float fits = std::min(float(width) / 1600.0f, float(height) / 1000.0f);
  return std::max(1.0f, std::floor(4.0f * fits) / 4.0f);
}

std::array<float, 4> clear_color() {
  const ImVec4 color = vec4(palette::panel);
  return {color.x, color.y, color.z, 1.0f};
}

}  // namespace quartet
