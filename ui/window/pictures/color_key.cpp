#include "ui/window/pictures/color_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/view/ticks.h"
#include "ui/widgets/chart_painter.h"
#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/widgets.h"
#include "ui/window/pictures/picture_cache.h"

namespace quartet {
namespace {

constexpr float bar_height = 8.0f;

/// One strip a pixel column would be many; a map has no more than some thirty knots.
void draw_gradient(const ScreenRect& bar, ColorMapId map) {
  constexpr int steps = 64;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (int i = 0; i < steps; ++i) {
    const auto at = [&](int step) { return float(step) / float(steps); };
    const ImU32 left = screen_color(sample(map, at(i)));
    const ImU32 right = screen_color(sample(map, at(i + 1)));
    list.AddRectFilledMultiColor({bar.x + bar.width * at(i), bar.y},
                                 {bar.x + bar.width * at(i + 1), bar.bottom()}, left, right, right,
                                 left);
  }
}

std::vector<Tick> bar_ticks(const ColorScale& scale, int wanted) {
  if (scale.spacing == Spacing::logarithmic) {
    return decade_ticks(int(std::lround(std::log10(scale.min))),
                        int(std::lround(std::log10(scale.max))));
  }
  return ticks_with_ends(scale.min, scale.max, wanted);
}

/// The ends first; numbers between them where there is room.
void draw_bar_ticks(const Ui& ui, const ScreenRect& bar, const ColorScale& scale, float right) {
  std::vector<Tick> ticks = bar_ticks(scale, std::max(2, int(bar.width / ui.px(64.0f))));
  if (ticks.size() > 1) {
    std::rotate(ticks.begin() + 1, ticks.end() - 1, ticks.end());
  }
  std::vector<std::pair<float, float>> taken;
  for (const Tick& tick : ticks) {
    const float width = text_width(ui.small, tick.label);
    const float x = bar.x + bar.width * scale_position(scale, tick.value);
    const float left = std::clamp(x - 0.5f * width, bar.x, std::max(bar.x, right - width));
    const float spare = ui.px(6.0f);
    const bool overlaps = std::any_of(taken.begin(), taken.end(), [&](const auto& other) {
      return left < other.second + spare && other.first < left + width + spare;
    });
    if (!overlaps) {
      taken.emplace_back(left, left + width);
      text_at(ui.small, left, bar.bottom() + ui.px(1.0f), palette::dim, tick.label);
    }
  }
}

/// Swatches with what they mean: in words if there is room, else each in a tooltip's reach.
void draw_legend(const Ui& ui, const ScreenRect& box, const std::vector<ColorMeaning>& legend) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  std::uint64_t pixels = 0;
  for (const ColorMeaning& entry : legend) {
    pixels += entry.pixels;
  }
  const float swatch = ui.px(9.0f);
  float x = box.x;
  float y = box.y + ui.px(4.0f);
  for (const ColorMeaning& entry : legend) {
    const std::string text =
        fmt::format("{} {:.0f} %", entry.label,
                    100.0 * double(entry.pixels) / double(std::max<std::uint64_t>(pixels, 1)));
    const float width = 1.6f * swatch + text_width(ui.small, text) + ui.px(10.0f);
    if (x > box.x && x + width > box.right()) {
      x = box.x;
      y += font_size(ui.small) + ui.px(2.0f);
    }
    list.AddRectFilled({x, y + ui.px(2.0f)}, {x + swatch, y + ui.px(2.0f) + swatch},
                       screen_color(entry.color), ui.px(2.0f));
    text_at(ui.small, x + 1.6f * swatch, y, palette::dim, text);
    x += width;
  }
}

}  // namespace

float color_key_height(const Ui& ui, ViewKind kind) {
  const float line = font_size(ui.small) + ui.px(2.0f);
  const ViewRow& row = view_row(kind);
  if (row.has_bar) {
    return ui.px(bar_height + 5.0f) + line;
  }
  return row.has_legend ? 2 * line + ui.px(4.0f) : 0.0f;
}

void draw_color_key(LabFrame& frame, const PictureSlot& slot, const ScreenRect& box) {
  const View* picture =
      frame.pictures.get(slot.texture, frame, slot.source, shown_choice(frame.state, slot));
  if (!picture || box.height <= 0.0f) {
    return;
  }
  const Ui& ui = frame.ui;
  if (!picture->legend.empty()) {
    draw_legend(ui, box, picture->legend);
  }
  if (!picture->bar) {
    return;
  }
  const ColorBar& bar = *picture->bar;
  ScreenRect strip{box.x, box.y + ui.px(4.0f), box.width, ui.px(bar_height)};
  if (!bar.cap_label.empty()) {
    // The colour that no map has, at the end that it is beyond.
    const ScreenRect cap = strip.cut_right(ui.px(12.0f));
    strip.cut_right(ui.px(2.0f));
    ImGui::GetWindowDrawList()->AddRectFilled({cap.x, cap.y}, {cap.right(), cap.bottom()},
                                              screen_color(cap_color));
  }
  draw_gradient(strip, bar.scale.color_map);
  draw_bar_ticks(ui, strip, bar.scale, box.right());
  ImGui::SetCursorScreenPos({strip.x, strip.y});
  invisible_button(fmt::format("key{}", slot.slot), {box.width, strip.height});
  frame.ui.mark(fmt::format("lane{}.slot{}.key", slot.lane, slot.slot));
  tooltip(ui, bar.cap_label.empty() ? bar.label : bar.label + "\nmagenta: " + bar.cap_label);
}

}  // namespace quartet
