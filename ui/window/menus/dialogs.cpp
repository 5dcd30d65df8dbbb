#include "ui/window/menus/dialogs.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/widgets.h"
#include "ui/window/keys.h"

namespace quartet {
namespace {

constexpr ImGuiWindowFlags dialog_flags =
    ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
    ImGuiWindowFlags_NoTitleBar;

/// A window in the middle that closes on a click beside it.
bool begin_dialog(const char* name, bool& open) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowFocus();
  const bool drawn = ImGui::Begin(name, nullptr, dialog_flags);
  if (ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_RootAndChildWindows) &&
      !ImGui::IsWindowAppearing()) {
    open = false;
  }
  return drawn;
}

void draw_row(const Ui& ui, float column, std::string_view keys, std::string_view what) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  text_at(ui.body, at.x, at.y, palette::text, std::string(keys));
  text_at(ui.body, at.x + column, at.y, palette::dim, std::string(what));
  ImGui::Dummy({column + text_width(ui.body, std::string(what)), font_size(ui.body)});
}

}  // namespace

void draw_help(LabFrame& frame) {
  if (!frame.state.help_open) {
    return;
  }
  const Ui& ui = frame.ui;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(18.0f), ui.px(14.0f)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8.0f), ui.px(4.0f)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(29, 33, 41, 252));
  if (begin_dialog("keys", frame.state.help_open)) {
    float column = 0.0f;
    for (const KeyRow& row : key_table()) {
      column = std::max(column, text_width(ui.body, std::string(row.shown)));
    }
    for (const MouseRow& row : mouse_table()) {
      column = std::max(column, text_width(ui.body, std::string(row.shown)));
    }
    column += ui.px(18.0f);
    for (const KeyRow& row : key_table()) {
      if (!row.shown.empty()) {
        draw_row(ui, column, row.shown, row.what);
      }
    }
    ImGui::Dummy({0.0f, ui.px(4.0f)});
    for (const MouseRow& row : mouse_table()) {
      draw_row(ui, column, row.shown, row.what);
    }
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    frame.ui.mark("dialog", {at.x, at.y, size.x, size.y});
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

void draw_export_form(LabFrame& frame) {
  ExportForm& form = frame.state.export_form;
  if (!form.open) {
    return;
  }
  Ui& ui = frame.ui;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(18.0f), ui.px(14.0f)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(29, 33, 41, 252));
  if (begin_dialog("export", form.open)) {
    ImGui::PushFont(ui.bold);
    ImGui::TextUnformatted("Export");
    ImGui::PopFont();
    ImGui::TextDisabled("PNG, PDF and EXR, with the command line that makes the same files");
    const auto lane_label = [&](int lane) {
      return lane < 0
                 ? std::string("the figure of all four lanes")
                 : fmt::format(
                       "lane {}: {}", lane + 1,
                       estimator(frame.state.request.lanes.settings[std::size_t(lane)].estimator)
                           .label);
    };
    const float width = ui.px(420.0f);
    combo(ui, "export.what", lane_label(form.lane), width, [&] {
      bool changed = false;
      for (int lane = -1; lane < int(frame.state.request.lanes.settings.size()); ++lane) {
        if (combo_row(ui, fmt::format("export.what.{}", lane), lane_label(lane),
                      form.lane == lane)) {
          form.lane = lane;
          changed = true;
        }
      }
      return changed;
    });
    ImGui::SetNextItemWidth(width);
    ImGui::InputText("##folder", &form.folder);
    ui.mark("export.folder");
    tooltip(ui, "Folder, made if need be; files of the same name are replaced");
    if (ImGui::Button("Cancel")) {
      form.open = false;
    }
    ui.mark("export.cancel");
    ImGui::SameLine();
    const bool ready = frame.snapshot && frame.snapshot->pass > 0 && !form.folder.empty();
    if (!ready || frame.saving) {
      ImGui::TextDisabled(form.folder.empty() ? "into which folder?"
                          : frame.saving      ? "the one before is being saved"
                                              : "no pass yet");
    } else if (ImGui::Button("Save")) {
      frame.orders.save = form;
      form.open = false;
    }
    ui.mark("export.save");
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

}  // namespace quartet
