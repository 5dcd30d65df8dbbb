#include "ui/window/dock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "renderer/measure/metrics.h"
#include "renderer/view/estimator_look.h"
#include "renderer/view/quality_chart.h"
#include "ui/widgets/chart_painter.h"
#include "ui/widgets/table_combo.h"
#include "ui/widgets/widgets.h"
#include "ui/window/menus/equalise_menu.h"
#include "ui/window/menus/metric_table.h"
#include "ui/window/menus/reference_menu.h"

namespace quartet {
namespace {

constexpr float margin = 8.0f;
constexpr float dock_bar_height = 30.0f;
constexpr float least_height = 110.0f;  // bar included
// A window lower than this at scale 1 has no room for lanes and dock at once unless asked.
constexpr float roomy = 760.0f;

void draw_fold(LabFrame& frame, bool open) {
  Ui& ui = frame.ui;
  if (icon_button(ui, "dock", open ? Icon::fold : Icon::unfold)) {
    frame.state.dock.open = !open;
  }
  tooltip(ui, open ? "Fold the dock  (D)" : "Unfold the dock: errors against a reference  (D)");
}

void edit_view(LabFrame& frame) {
  constexpr std::array labels{"error curves", "estimators' quality"};
  constexpr std::array tips{
      "Error of each lane as samples are taken",
      "What each estimator's error says of the true one: pixels in groups of about equal estimate"};
  DockView& chosen = frame.state.dock.view;
  combo(frame.ui, "dock.view", labels[std::size_t(chosen)], frame.ui.px(150.0f), [&] {
    bool changed = false;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (combo_row(frame.ui, fmt::format("dock.view.{}", i), labels[i], std::size_t(chosen) == i,
                    tips[i])) {
        chosen = DockView(i);
        changed = true;
      }
    }
    return changed;
  });
}

void edit_metric(LabFrame& frame) {
  MetricId& chosen = frame.state.request.lanes.metric;
  combo(frame.ui, "dock.metric", std::string(metric(chosen).label), frame.ui.px(130.0f), [&] {
    return table_rows(frame.ui, "dock.metric", metrics(), chosen, &Metric::definition);
  });
  tooltip(frame.ui, std::string(metric(chosen).definition));
}

void edit_effort(LabFrame& frame) {
  Effort& chosen = frame.state.dock.effort;
  combo(frame.ui, "dock.effort", std::string(effort_row(chosen).label), frame.ui.px(190.0f),
        [&] { return table_rows(frame.ui, "dock.effort", efforts(), chosen); });
}

void draw_bar(LabFrame& frame, const ScreenRect& bar, bool open) {
  Ui& ui = frame.ui;
  ImGui::SetCursorScreenPos(
      {bar.x + ui.px(margin), bar.y + 0.5f * (bar.height - ImGui::GetFrameHeight())});
  draw_fold(frame, open);
  ImGui::SameLine(0.0f, ui.px(8.0f));
  if (open) {
    edit_view(frame);
    ImGui::SameLine(0.0f, ui.px(6.0f));
    edit_metric(frame);
    if (frame.state.dock.view == DockView::curves) {
      ImGui::SameLine(0.0f, ui.px(6.0f));
      leading_label(ui, "against");
      edit_effort(frame);
    }
  } else {
    leading_label(ui, "errors against a reference");
  }
  ImGui::SameLine(0.0f, ui.px(16.0f));
  const float left = ImGui::GetCursorScreenPos().x;
  const float right = draw_equalise_menu(frame, bar, bar.right() - ui.px(margin));
  draw_reference_menu(frame, {left, bar.y, right - ui.px(6.0f) - left, bar.height});
}

/// The upper edge can be dragged.
void edit_height(LabFrame& frame, const ScreenRect& area, const ScreenRect& box) {
  Ui& ui = frame.ui;
  const float half = ui.px(4.0f);
  ImGui::SetCursorScreenPos({box.x, box.y - half});
  invisible_button("dock.edge", {box.width, 2 * half});
  ui.mark("dock.edge");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
    ImGui::GetWindowDrawList()->AddLine({box.x, box.y}, {box.right(), box.y}, palette::dim,
                                        ui.px(1.5f));
  }
  if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.y != 0.0f) {
    frame.state.dock.height =
        std::max(least_height, (area.bottom() - ImGui::GetIO().MousePos.y) / ui.scale);
  }
}

void draw_curves(LabFrame& frame, const ScreenRect& box) {
  if (!frame.snapshot || !frame.snapshot->reference) {
    return;
  }
  EffortChart curves;
  curves.effort = frame.state.dock.effort;
  curves.noise_floor = noise_floor(frame, frame.snapshot->metric);
  paint_chart(frame.ui, "dock.chart", effort_chart(*frame.snapshot, curves), box);
}

/// A plot a lane, side by side. They are of the picture that was evaluated last, while a drag goes
/// on of an older one than the columns show.
void draw_qualities(LabFrame& frame, ScreenRect box) {
  Ui& ui = frame.ui;
  const auto& qualities = frame.evaluation.quality;
  if (!qualities || qualities->empty()) {
    text_at(ui.small, box.x, box.y, palette::dim, "known once the lanes rest");
    return;
  }
  const float gap = ui.px(10.0f);
  const float count = float(qualities->size());
  const float width = (box.width - (count - 1.0f) * gap) / count;
  for (std::size_t i = 0; i < qualities->size(); ++i) {
    const LaneSnapshot& lane = frame.evaluation.snapshot->lanes[i];
    paint_chart(
        ui, fmt::format("dock.quality{}", i),
        quality_chart((*qualities)[i], std::string(estimator(lane.settings.estimator).label),
                      look_of(lane.settings.estimator).screen),
        box.cut_left(width));
    box.cut_left(gap);
  }
}

}  // namespace

bool dock_is_open(const LabFrame& frame, const ScreenRect& area) {
  return frame.state.dock.open.value_or(frame.state.request.lanes.reference &&
                                        area.height >= frame.ui.px(roomy));
}

float dock_height(const LabFrame& frame, const ScreenRect& area) {
  const Ui& ui = frame.ui;
  if (!dock_is_open(frame, area)) {
    return ui.px(dock_bar_height);
  }
  const float wanted = frame.state.dock.height > 0.0f
                           ? ui.px(frame.state.dock.height)
                           : std::clamp(0.25f * area.height, ui.px(150.0f), ui.px(320.0f));
  return std::round(
      std::clamp(wanted, ui.px(least_height), std::max(ui.px(least_height), 0.5f * area.height)));
}

void draw_dock(LabFrame& frame, const ScreenRect& area, const ScreenRect& box) {
  Ui& ui = frame.ui;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool open = dock_is_open(frame, area);
  if (std::exchange(frame.state.dock.toggle, false)) {
    frame.state.dock.open = !open;
  }
  list.AddRectFilled({box.x, box.y}, {box.right(), box.y + ui.px(1.0f)}, palette::line);
  ui.mark("dock.box", box);
  ScreenRect rest = box;
  draw_bar(frame, rest.cut_top(ui.px(dock_bar_height)), open);
  if (!open) {
    return;
  }
  edit_height(frame, area, box);
  rest = rest.inset(ui.px(margin), 0.0f);
  rest.cut_bottom(ui.px(4.0f));
  if (!frame.state.request.lanes.reference) {
    draw_missing_reference(frame, rest);
    return;
  }
  const ScreenRect table = rest.cut_right(std::max(0.4f * rest.width, ui.px(420.0f)));
  rest.cut_right(ui.px(16.0f));
  if (frame.state.dock.view == DockView::quality) {
    draw_qualities(frame, rest);
  } else {
    draw_curves(frame, rest);
  }
  draw_metric_table(frame, table);
}

}  // namespace quartet
