#pragma once

#include <imgui.h>

#include <array>
#include <filesystem>
#include <map>
#include <string>

#include "renderer/adaptive/estimators/estimator.h"
#include "ui/widgets/screen_rect.h"

namespace quartet {

/// Colours of the window: a calm dark ground, so that the pictures are what shines.
namespace palette {
inline constexpr ImU32 panel = IM_COL32(23, 26, 32, 255);
inline constexpr ImU32 gap = IM_COL32(12, 14, 18, 255);
inline constexpr ImU32 well = IM_COL32(14, 16, 21, 255);  ///< behind plots and pictures
inline constexpr ImU32 line = IM_COL32(44, 49, 60, 255);
inline constexpr ImU32 text = IM_COL32(228, 231, 237, 255);
inline constexpr ImU32 dim = IM_COL32(148, 156, 170, 255);
inline constexpr ImU32 faint = IM_COL32(92, 99, 112, 255);
inline constexpr ImU32 error = IM_COL32(255, 118, 108, 255);
inline constexpr ImU32 good = IM_COL32(110, 214, 150, 255);
inline constexpr ImU32 shade = IM_COL32(8, 9, 12, 190);  ///< under text on a picture
inline constexpr ImU32 check = IM_COL32(94, 178, 246, 255);
inline constexpr std::array<ImU32, 3> channels{
    IM_COL32(255, 104, 96, 255), IM_COL32(104, 212, 104, 255), IM_COL32(110, 158, 255, 255)};
}  // namespace palette

/// As everywhere: look_of().
ImU32 estimator_color(EstimatorId estimator);
ImU32 with_alpha(ImU32 color, float alpha);

/// What every part of the window draws with.
struct Ui {
  float scale = 1.0f;
  ImFont* body = nullptr;
  ImFont* bold = nullptr;
  ImFont* small = nullptr;
  /// Where each widget was drawn last, by name: what a test, or a script, aims at.
  std::map<std::string, ScreenRect> widgets;
  /// The one among them that the mouse holds; empty if it holds none.
  std::string held;

  float px(float length) const { return length * scale; }
  void mark(const std::string& name);  ///< the last ImGui item
  void mark(const std::string& name, const ScreenRect& rect) { widgets[name] = rect; }
};

/// Where fonts are looked for.
struct FontFolders {
  std::filesystem::path inter = "/usr/share/fonts/opentype/inter";
  std::filesystem::path dejavu = "/usr/share/fonts/truetype/dejavu";
};

/// Loads Inter, or DejaVu where it is missing, into the current context and sets its style.
/// Between two frames; whoever draws must forget the fonts of before.
void set_theme(Ui& ui, float scale, const FontFolders& folders = {});

/// A scale of text and controls that suits a window whose monitor says nothing.
float natural_scale(int width, int height);

/// The background that an application clears its window to.
std::array<float, 4> clear_color();

}  // namespace quartet
