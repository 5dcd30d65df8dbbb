#include "ui/window/menus/view_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>

#include "renderer/view/tone_map.h"
#include "ui/widgets/table_combo.h"
#include "ui/widgets/widgets.h"
#include "ui/window/lab_layout.h"

namespace quartet {

void draw_exposure(LabFrame& frame, float width) {
  float& exposure = frame.state.view.exposure;
  const float start = ImGui::GetCursorScreenPos().x;
  // "+0.5 EV" says what it is where the room is short.
  if (width > frame.ui.px(160.0f)) {
    leading_label(frame.ui, "exposure");
  }
  const float field = frame.ui.px(54.0f);
  width -= ImGui::GetCursorScreenPos().x - start + field;
  slider(frame.ui, "exposure", exposure, {-8.0f, 8.0f}, width, palette::text);
  tooltip(frame.ui, "In stops  (E, Shift+E; N sets it to the picture)");
  ImGui::SameLine(0.0f, 0.0f);
  number_field(frame.ui, "exposure.number", exposure, -largest_exposure, largest_exposure,
               "%+.1f EV", field);
}

void draw_tone_map(LabFrame& frame, float width) {
  ToneMap& tone_map = frame.state.view.tone_map;
  combo(frame.ui, "tone_map", std::string(tone_map_row(tone_map).label), width, [&] {
    return table_rows(frame.ui, "tone_map", tone_maps(), tone_map, &ToneMapRow::source);
  });
  tooltip(frame.ui, "Tone map  (T)");
}

std::string heat_label(HeatRange heat) {
  return heat == HeatRange::linked ? "heat: linked" : "heat: report";
}

void draw_heat(LabFrame& frame, float width) {
  HeatRange& heat = frame.state.view.heat;
  const bool linked = heat == HeatRange::linked;
  combo(frame.ui, "heat", heat_label(heat), width, [&] {
    const bool to_linked =
        combo_row(frame.ui, "heat.linked", "linked: 0 to the highest of all lanes", linked);
    const bool to_report = combo_row(frame.ui, "heat.report",
                                     "report: lowest to highest of each, blue-green-red", !linked);
    heat = to_linked ? HeatRange::linked : to_report ? HeatRange::report : heat;
    return to_linked || to_report;
  });
  tooltip(frame.ui, "Scale of samples per pixel  (G)");
}

namespace {

std::string percent_text(float scale) {
  return fmt::format("{:.0f} %", 100.0f * scale);
}

/// The scale of text and controls: the display's own or one of the usual.
bool edit_scale(LabFrame& frame) {
  constexpr std::array scales{0.75f, 1.0f, 1.25f, 1.5f, 1.75f, 2.0f, 2.5f, 3.0f};
  float& scale = frame.state.ui_scale;
  ImGui::TextDisabled("text and controls");
  bool changed = combo_row(frame.ui, "layout.scale.0", "as the display says", scale == 0.0f);
  scale = changed ? 0.0f : scale;
  for (const float each : scales) {
    if (combo_row(frame.ui, fmt::format("layout.scale.{:g}", each), percent_text(each),
                  scale == each)) {
      scale = each;
      changed = true;
    }
  }
  return changed;
}

}  // namespace

void draw_layout(LabFrame& frame, float width) {
  LabLayout& layout = frame.state.layout;
  combo(frame.ui, "layout", std::string(layout_row(layout).label), width, [&] {
    const bool changed = table_rows(frame.ui, "layout", layouts(), layout);
    ImGui::Separator();
    return edit_scale(frame) || changed;
  });
  tooltip(frame.ui, "Layout  (L), and the size of text and controls");
}

}  // namespace quartet
