#include "ui/window/menus/reference_menu.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/widgets.h"
#include "ui/window/menus/metric_table.h"

namespace quartet {
namespace {

using Activity = ReferenceStatus::Activity;

std::string duration_text(double seconds) {
  return seconds < 99.5     ? fmt::format("{:.0f} s", seconds)
         : seconds < 5970.0 ? fmt::format("{:.0f} min", seconds / 60.0)
                            : fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string origin_text(const Reference& reference) {
  if (!reference.ours()) {
    return fmt::format("reference {}", reference.path.filename().string());
  }
  return fmt::format("reference of {} spp", reference.spp);
}

void edit_computation(LabFrame& frame) {
  ReferenceForm& form = frame.state.reference_form;
  Ui& ui = frame.ui;
  ImGui::TextDisabled("Uniform sampling with a seed of its own, while the lanes rest");
  ImGui::SetNextItemWidth(ui.px(110.0f));
  ImGui::InputScalar("samples per pixel", ImGuiDataType_U64, &form.spp);
  ui.mark("reference.spp");
  form.spp = std::clamp<std::uint64_t>(form.spp, 2, 1u << 30);
  ImGui::SameLine();
  if (ImGui::Button("Compute")) {
    frame.orders.reference = {{}, form.spp};
    ImGui::CloseCurrentPopup();
  }
  ui.mark("reference.compute");
  if (frame.reference.activity == Activity::computing) {
    ImGui::SameLine();
    if (ImGui::Button("Stop")) {
      frame.orders.reference = {{}, 0};
      ImGui::CloseCurrentPopup();
    }
    ui.mark("reference.stop");
    tooltip(ui, "What was computed is kept, and gone on with next time");
  }
}

void edit_path(LabFrame& frame) {
  ReferenceForm& form = frame.state.reference_form;
  Ui& ui = frame.ui;
  ImGui::SetNextItemWidth(ui.px(330.0f));
  const bool entered = ImGui::InputText("##path", &form.path, ImGuiInputTextFlags_EnterReturnsTrue);
  ui.mark("reference.path");
  ImGui::SameLine();
  const bool pressed = ImGui::Button("Load");
  ui.mark("reference.load");
  if ((entered || pressed) && !form.path.empty()) {
    frame.orders.reference = {form.path, 0};
    ImGui::CloseCurrentPopup();
  }
  ImGui::TextDisabled("an EXR of this scene, size and camera; or drop it on the window");
}

}  // namespace

std::vector<std::string> reference_texts(const LabFrame& frame) {
  const ReferenceStatus& status = frame.reference;
  std::vector<std::string> texts;
  if (status.activity == Activity::loading) {
    return {"loading the reference"};
  }
  const std::string have = status.reference ? origin_text(*status.reference) : "no reference";
  if (status.activity == Activity::computing && status.target > 0) {
    const std::string so_far = fmt::format("computing {} of {} spp", status.spp, status.target);
    const std::string left = status.waits ? ", waits for the lanes"
                             : status.seconds_left > 0.0
                                 ? fmt::format(", {} left", duration_text(status.seconds_left))
                                 : "";
    return {have + " · " + so_far + left, so_far + left, so_far};
  }
  if (status.reference) {
    if (const auto floor = noise_floor(frame, frame.state.request.lanes.metric)) {
      texts.push_back(fmt::format("{} · its own noise: {} {:.2g}", have,
                                  metric(frame.state.request.lanes.metric).label, *floor));
    }
  }
  texts.push_back(have);
  return texts;
}

void draw_reference_menu(LabFrame& frame, const ScreenRect& box) {
  Ui& ui = frame.ui;
  const float button = text_width(ui.body, "Reference…") + ui.px(22.0f);
  ImGui::SetCursorScreenPos(
      {box.right() - button, box.y + 0.5f * (box.height - ImGui::GetFrameHeight())});
  if (ImGui::Button("Reference…", {button, 0.0f})) {
    ImGui::OpenPopup("reference");
  }
  ui.mark("reference");
  tooltip(ui, "The truth that lanes are measured against: compute it, or load it");
  if (ImGui::BeginPopup("reference")) {
    edit_computation(frame);
    ImGui::Separator();
    edit_path(frame);
    ImGui::EndPopup();
  }
  const std::string text =
      fitting_text(ui.small, reference_texts(frame), box.width - button - ui.px(12.0f));
  const float y = box.y + 0.5f * (box.height - font_size(ui.small));
  text_left_of(ui.small, box.right() - button - ui.px(12.0f), y, palette::dim, text);
  ui.mark("reference.text", {box.x, box.y, box.width - button - ui.px(12.0f), box.height});
}

void draw_missing_reference(LabFrame& frame, const ScreenRect& box) {
  Ui& ui = frame.ui;
  const bool working = frame.reference.activity != Activity::idle;
  const std::string text = working ? reference_texts(frame).front()
                                   : "Errors are measured against a reference, and there is none "
                                     "for this view yet.";
  const float y = box.center_y() - font_size(ui.body) - ui.px(4.0f);
  text_at(ui.body, box.center_x() - 0.5f * text_width(ui.body, text), y, palette::dim, text);
  if (working) {
    return;
  }
  const std::string label =
      fmt::format("Compute one of {} samples per pixel", frame.state.reference_form.spp);
  const float width = text_width(ui.body, label) + ui.px(24.0f);
  ImGui::SetCursorScreenPos({box.center_x() - 0.5f * width, box.center_y() + ui.px(4.0f)});
  if (ImGui::Button(label.c_str(), {width, 0.0f})) {
    frame.orders.reference = {{}, frame.state.reference_form.spp};
  }
  ui.mark("dock.compute");
  tooltip(ui, "In the background, while the lanes rest");
}

}  // namespace quartet
