#include "ui/window/menus/equalise_menu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/adaptive/effort.h"
#include "renderer/measure/metrics.h"
#include "ui/widgets/widgets.h"

namespace quartet {
namespace {

/// What the lanes have on average now: where a budget begins.
void fill(EqualiseForm& form, const Snapshot& snapshot) {
  form = {};
  const double lanes = double(snapshot.lanes.size());
  for (const LaneSnapshot& lane : snapshot.lanes) {
    const PassRecord& last = lane.history.back();
    form.spp += float(mean_spp(last, snapshot.pixels()) / lanes);
    form.seconds += float(last.seconds / lanes);
    form.error += std::isnan(last.truth.error) ? 0.0f : float(last.truth.error / lanes);
  }
}

/// A budget to type and a button that asks for it.
bool edit_budget(Ui& ui, const std::string& name, float& value, const std::string& unit,
                 const char* format) {
  ImGui::SetNextItemWidth(ui.px(90.0f));
  if (ImGui::InputFloat(("##" + name).c_str(), &value, 0.0f, 0.0f, format)) {
    constexpr float largest = 1e9f;
    value = std::clamp(value, 0.0f, largest);
  }
  ui.mark(name + ".value");
  ImGui::SameLine();
  ImGui::TextUnformatted(unit.c_str());
  ImGui::SameLine(ui.px(300.0f));
  const bool pressed = ImGui::Button(("Equalise##" + name).c_str());
  ui.mark(name);
  return pressed && value > 0.0f;
}

void draw_menu(LabFrame& frame) {
  EqualiseForm& form = frame.state.equalise_form;
  Ui& ui = frame.ui;
  const MetricId chosen = frame.state.request.lanes.metric;
  ImGui::TextDisabled("Thresholds with which all lanes have, after pass %u,", frame.snapshot->pass);
  EqualiseOrder order;
  order.passes = frame.snapshot->pass;
  if (edit_budget(ui, "equalise.spp", form.spp, "samples per pixel", "%.2f")) {
    order.spp = double(form.spp);
  }
  if (edit_budget(ui, "equalise.seconds", form.seconds, "seconds, as if alone", "%.3f")) {
    order.seconds = double(form.seconds);
  }
  if (!frame.snapshot->reference) {
    ImGui::TextDisabled("the same error: needs a reference");
  } else if (edit_budget(ui, "equalise.error", form.error, std::string(metric(chosen).label),
                         "%.3g")) {
    order.error = double(form.error);
  }
  if (order.spp || order.seconds || order.error) {
    frame.orders.equalise = order;
    ImGui::CloseCurrentPopup();
  }
}

}  // namespace

float draw_equalise_menu(LabFrame& frame, const ScreenRect& bar, float right) {
  Ui& ui = frame.ui;
  const EqualiseProgress& progress = frame.equalising;
  const bool working = progress.lanes > 0;
  const std::string text =
      working ? fmt::format("equalising lane {} of {}  ×",
                            std::min(progress.done + 1, progress.lanes), progress.lanes)
              : "Equalise…";
  const float width = text_width(ui.body, text) + ui.px(22.0f);
  ImGui::SetCursorScreenPos({right - width, bar.y + 0.5f * (bar.height - ImGui::GetFrameHeight())});
  const bool pressed = ImGui::Button((text + "###equalise").c_str(), {width, 0.0f});
  ui.mark("equalise");
  tooltip(ui, working ? "A click ends it"
                      : "Different criteria have different units: find the thresholds with which "
                        "all lanes take the same samples or seconds, or reach the same error");
  const bool ready = frame.snapshot && frame.snapshot->pass > 0;
  if (pressed && working) {
    frame.orders.stop_equalising = true;
  } else if (pressed && ready) {
    fill(frame.state.equalise_form, *frame.snapshot);
    ImGui::OpenPopup("equalise.menu");
  }
  if (ready && ImGui::BeginPopup("equalise.menu")) {
    draw_menu(frame);
    ImGui::EndPopup();
  }
  return right - width;
}

}  // namespace quartet
