#include "ui/widgets/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/widgets/imgui_compat.h"

namespace quartet {
namespace {

float position_of(float value, const SliderRange& range) {
  if (range.logarithmic) {
    const float clamped = std::clamp(value, range.low, range.high);
    return std::log(clamped / range.low) / std::log(range.high / range.low);
  }
  return std::clamp((value - range.low) / (range.high - range.low), 0.0f, 1.0f);
}

float value_at(float t, const SliderRange& range) {
  t = std::clamp(t, 0.0f, 1.0f);
  return range.logarithmic ? range.low * std::pow(range.high / range.low, t)
                           : range.low + t * (range.high - range.low);
}

/// Of the next item. To ImGui nothing and less means something else.
void set_item_width(float width) {
  ImGui::SetNextItemWidth(std::max(1.0f, width));
}

using Points = std::initializer_list<ImVec2>;

void fill(ImDrawList& list, ImVec2 origin, float size, ImU32 color, Points points) {
  std::array<ImVec2, 4> placed;
  std::size_t count = 0;
  for (const ImVec2 point : points) {
    placed[count++] = {origin.x + point.x * size, origin.y + point.y * size};
  }
  list.AddConvexPolyFilled(placed.data(), int(count), color);
}

/// In a square of `size` at `origin`.
void draw_icon(ImDrawList& list, Icon icon, ImVec2 origin, float size, ImU32 color) {
  const auto bar = [&](float x0, float x1) {
    list.AddRectFilled({origin.x + x0 * size, origin.y + 0.1f * size},
                       {origin.x + x1 * size, origin.y + 0.9f * size}, color);
  };
  switch (icon) {
    case Icon::to_start:
      bar(0.08f, 0.22f);
      fill(list, origin, size, color, {{0.92f, 0.1f}, {0.92f, 0.9f}, {0.3f, 0.5f}});
      break;
    case Icon::back:
      fill(list, origin, size, color, {{0.8f, 0.1f}, {0.8f, 0.9f}, {0.12f, 0.5f}});
      break;
    case Icon::pause:
      bar(0.18f, 0.4f);
      bar(0.6f, 0.82f);
      break;
    case Icon::play:
      fill(list, origin, size, color, {{0.15f, 0.05f}, {0.95f, 0.5f}, {0.15f, 0.95f}});
      break;
    case Icon::forward:
      fill(list, origin, size, color, {{0.08f, 0.1f}, {0.7f, 0.5f}, {0.08f, 0.9f}});
      bar(0.78f, 0.92f);
      break;
    case Icon::fold:
      fill(list, origin, size, color, {{0.1f, 0.25f}, {0.9f, 0.25f}, {0.5f, 0.75f}});
      break;
    case Icon::unfold:
      fill(list, origin, size, color, {{0.1f, 0.75f}, {0.5f, 0.25f}, {0.9f, 0.75f}});
      break;
    case Icon::restart:
    case Icon::reset: {
      const ImVec2 center(origin.x + 0.5f * size, origin.y + 0.53f * size);
      constexpr float pi = 3.14159265f;
      list.PathArcTo(center, 0.38f * size, -0.25f * pi, 1.45f * pi, 20);
      list.PathStroke(color, 0, std::max(1.0f, 0.12f * size));
      fill(list, origin, size, color, {{0.52f, -0.06f}, {0.92f, 0.14f}, {0.56f, 0.44f}});
      break;
    }
  }
}

}  // namespace

bool invisible_button(const std::string& name, ImVec2 size, ImGuiButtonFlags flags) {
  return ImGui::InvisibleButton(name.c_str(), {std::max(1.0f, size.x), std::max(1.0f, size.y)},
                                flags);
}

bool slider(Ui& ui, const std::string& name, float& value, const SliderRange& range, float width,
            ImU32 color) {
  const float height = ImGui::GetFrameHeight();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float knob = ui.px(6.0f);
  invisible_button(name, {std::max(width, 3 * knob), height});
  ui.mark(name);
  const float left = origin.x + knob;
  const float span = std::max(width, 3 * knob) - 2 * knob;
  bool changed = false;
  if (ImGui::IsItemActive()) {
    const float wanted = value_at((ImGui::GetIO().MousePos.x - left) / span, range);
    // A press on the knob of a value beyond the slider must not move it.
    if (ImGui::IsMouseDragging(0, 1.0f) ||
        std::abs(left + span * position_of(value, range) - ImGui::GetIO().MousePos.x) > knob) {
      changed = wanted != value;
      value = wanted;
    }
  }
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
  const float y = std::round(origin.y + 0.5f * height);
  const float at = left + span * position_of(value, range);
  const float half = ui.px(1.5f);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({left, y - half}, {left + span, y + half}, IM_COL32(58, 64, 77, 255), half);
  list.AddRectFilled({left, y - half}, {at, y + half}, with_alpha(color, 0.75f), half);
  list.AddCircleFilled({at, y}, lit ? knob * 1.15f : knob, color, 20);
  return changed;
}

bool number_field(Ui& ui, const std::string& name, float& value, float low, float high,
                  const char* format, float width) {
  set_item_width(width);
  ImGui::PushStyleColor(ImGuiCol_FrameBg, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(2.0f), ImGui::GetStyle().FramePadding.y});
  float edited = value;
  const float speed = std::max(std::abs(value), 1e-3f * (high - low)) * 0.005f;
  const bool changed = ImGui::DragScalar(("##" + name).c_str(), ImGuiDataType_Float, &edited, speed,
                                         &low, &high, format, ImGuiSliderFlags_NoRoundToFormat);
  ui.mark(name);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  if (changed && std::isfinite(edited)) {
    value = std::clamp(edited, low, high);
    return true;
  }
  return false;
}

bool icon_button(Ui& ui, const std::string& name, Icon icon, bool enabled, float width) {
  const float height = ImGui::GetFrameHeight();
  const bool plain = icon == Icon::reset;  // beside a slider: no frame
  const ImVec2 size(width > 0 ? width : height * (plain ? 0.8f : 1.15f), height);
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const bool pressed = invisible_button(name, size) && enabled;
  ui.mark(name);
  const bool lit = enabled && ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (!plain || lit) {
    list.AddRectFilled(origin, {origin.x + size.x, origin.y + size.y},
                       ImGui::GetColorU32(lit ? ImGuiCol_ButtonHovered : ImGuiCol_Button),
                       ImGui::GetStyle().FrameRounding);
  }
  const float side = ui.px(plain ? 10.0f : 12.0f);
  draw_icon(list, icon, {origin.x + 0.5f * (size.x - side), origin.y + 0.5f * (size.y - side)},
            side, enabled ? (plain && !lit ? palette::dim : palette::text) : palette::faint);
  return pressed;
}

bool combo(Ui& ui, const std::string& name, const std::string& shown, float width,
           const std::function<bool()>& rows) {
  set_item_width(width);
  bool changed = false;
  const bool open =
      ImGui::BeginCombo(("##" + name).c_str(), shown.c_str(), ImGuiComboFlags_HeightLargest);
  if (open) {
    changed = rows();
    ImGui::EndCombo();
  }
  ui.mark(name);
  return changed;
}

float combo_width(const Ui& ui, std::string_view label) {
  return text_width(ui.body, std::string(label)) + ui.px(20.0f) + ImGui::GetFrameHeight();
}

bool combo_row(Ui& ui, const std::string& name, const std::string& label, bool chosen,
               const std::string& tip) {
  const bool pressed = ImGui::Selectable((label + "##" + name).c_str(), chosen);
  ui.mark(name);
  if (!tip.empty()) {
    tooltip(ui, tip);
  }
  return pressed;
}

float leading_label(const Ui& ui, const std::string& text) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  text_at(ui.body, at.x, at.y + 0.5f * (ImGui::GetFrameHeight() - font_size(ui.body)), palette::dim,
          text);
  const float width = text_width(ui.body, text) + ui.px(6.0f);
  ImGui::SetCursorScreenPos({at.x + width, at.y});
  return width;
}

void tooltip(const Ui& ui, const std::string& text) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsItemActive() ||
      text.empty()) {
    return;
  }
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ui.px(340.0f));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

float text_width(ImFont* font, const std::string& text) {
  return font->CalcTextSizeA(font_size(font), FLT_MAX, 0.0f, text.c_str()).x;
}

std::string fitting_text(ImFont* font, const std::vector<std::string>& texts, float width) {
  for (const std::string& text : texts) {
    if (text_width(font, text) <= width) {
      return text;
    }
  }
  return texts.back();
}

void text_at(ImFont* font, float x, float y, ImU32 color, const std::string& text) {
  ImGui::GetWindowDrawList()->AddText(font, font_size(font), {std::round(x), std::round(y)}, color,
                                      text.c_str());
}

void text_left_of(ImFont* font, float x, float y, ImU32 color, const std::string& text) {
  text_at(font, x - text_width(font, text), y, color, text);
}

ScreenRect badge(const Ui& ui, float x, float y, ImU32 color, const std::string& text) {
  const float pad = ui.px(5.0f);
  const ScreenRect box{x, y, text_width(ui.small, text) + 2 * pad,
                       font_size(ui.small) + ui.px(4.0f)};
  ImGui::GetWindowDrawList()->AddRectFilled({box.x, box.y}, {box.right(), box.bottom()},
                                            palette::shade, ui.px(3.0f));
  text_at(ui.small, x + pad, y + ui.px(2.0f), color, text);
  return box;
}

}  // namespace quartet
