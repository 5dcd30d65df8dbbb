#include "ui/window/menus/scene_menu.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include "renderer/scene/load_scene.h"
#include "renderer/scene/synthetic.h"
#include "renderer/study/stability/failure_case.h"
#include "renderer/view/views.h"
#include "ui/widgets/widgets.h"

namespace quartet {
namespace {

void draw_builtin(LabFrame& frame) {
  for (const std::string& name : builtin_scenes()) {
    // Those below a folder are failure cases.
    if (name.find('/') == std::string::npos &&
        combo_row(frame.ui, "scene." + name, name, name == scene_label(frame.state))) {
      frame.orders.load_scene = name;
    }
  }
}

void draw_failures(LabFrame& frame) {
  ImGui::TextDisabled("where methods fail");
  for (const FailureCase& row : failure_cases()) {
    if (combo_row(frame.ui, fmt::format("scene.failure.{}", row.id), std::string(row.mode),
                  frame.state.failure == &row, std::string(row.watch))) {
      frame.state.failure_asked = &row;
      frame.orders.load_scene = std::string(row.scene);
    }
  }
}

void draw_synthetics(LabFrame& frame) {
  ImGui::TextDisabled("distributions in the place of tracing");
  for (const Synthetic& row : synthetics()) {
    const std::string name = fmt::format("synthetic:{}", row.id);
    if (combo_row(frame.ui, "scene." + name, std::string(row.label), frame.state.scene == name,
                  fmt::format("mean {:.4g}, variance {:.4g}", row.mean, row.variance))) {
      frame.orders.load_scene = name;
    }
  }
}

void draw_path(LabFrame& frame) {
  LabState& state = frame.state;
  ImGui::TextDisabled("a Mitsuba 3 file, or drop it on the window");
  ImGui::SetNextItemWidth(frame.ui.px(360.0f));
  const bool entered =
      ImGui::InputText("##path", &state.path_field, ImGuiInputTextFlags_EnterReturnsTrue);
  frame.ui.mark("scene.path");
  ImGui::SameLine();
  const bool pressed = ImGui::Button("Load");
  frame.ui.mark("scene.load");
  if ((entered || pressed) && !state.path_field.empty()) {
    frame.orders.load_scene = state.path_field;
    ImGui::CloseCurrentPopup();
  }
}

}  // namespace

std::string scene_label(const LabState& state) {
  return state.trace_scene() ? state.trace_scene()->scene().name
                             : std::filesystem::path(state.scene).stem().string();
}

void draw_scene(LabFrame& frame, float width) {
  combo(frame.ui, "scene", scene_label(frame.state), width, [&] {
    draw_path(frame);
    ImGui::Separator();
    draw_builtin(frame);
    ImGui::Separator();
    // Side by side, because below each other they would not fit a small window.
    if (ImGui::BeginTable("sources", 2, ImGuiTableFlags_SizingFixedFit)) {
      ImGui::TableNextColumn();
      draw_failures(frame);
      ImGui::TableNextColumn();
      draw_synthetics(frame);
      ImGui::EndTable();
    }
    return false;
  });
  std::string tip = "The scene";
  if (const TraceScene* scene = frame.state.trace_scene()) {
    tip = scene->scene().path.string();
    for (const std::string& warning : scene->scene().warnings) {
      tip += "\n" + warning;
    }
  }
  tooltip(frame.ui, tip);
}

void show_failure(LabState& state, const FailureCase& failure) {
  state.failure = &failure;
  for (LaneSlots& slots : state.slots) {
    slots[1] = {find_view(failure.view).key, 0};
  }
  const PicturePart& region = failure.region;
  state.pan_zoom.zoom = failure.zoom;
  state.pan_zoom.center = {0.5f * float(region.left + region.right),
                           0.5f * float(region.top + region.bottom)};
}

}  // namespace quartet
