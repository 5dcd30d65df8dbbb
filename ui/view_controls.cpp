#include "ui/view_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>

#include "renderer/image/tone_map.h"
#include "ui/widgets.h"

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
  number_field(frame.ui, "exposure.number", exposure, -100.0f, 100.0f, "%+.1f EV", field);
}

void draw_tone_map(LabFrame& frame, float width) {
  ToneMap& tone_map = frame.state.view.tone_map;
  combo(frame.ui, "tone_map", std::string(tone_map_row(tone_map).label), width, [&] {
    bool changed = false;
    for (const ToneMapRow& row : tone_maps()) {
      if (combo_row(frame.ui, fmt::format("tone_map.{}", row.id), std::string(row.label),
                    row.key == tone_map, std::string(row.source))) {
        tone_map = row.key;
        changed = true;
      }
    }
    return changed;
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

constexpr std::array layout_names{"columns", "2 × 2", "one large"};

}  // namespace

std::string layout_label(LabLayout layout) {
  return layout_names[std::size_t(layout)];
}

void draw_layout(LabFrame& frame, float width) {
  LabLayout& layout = frame.state.layout;
  combo(frame.ui, "layout", layout_names[std::size_t(layout)], width, [&] {
    bool changed = false;
    for (std::size_t i = 0; i < layout_names.size(); ++i) {
      if (combo_row(frame.ui, fmt::format("layout.{}", i), layout_names[i],
                    std::size_t(layout) == i)) {
        layout = LabLayout(i);
        changed = true;
      }
    }
    return changed;
  });
  tooltip(frame.ui, "Layout  (L)");
}

}  // namespace quartet
