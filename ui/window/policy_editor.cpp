#include "ui/window/policy_editor.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/adaptive/policies/policy_parameter.h"
#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/table_combo.h"
#include "ui/widgets/widgets.h"
#include "ui/window/lab_frame.h"

namespace quartet {
namespace {

/// What of a policy stands in the header, as a slider: the first of its parameters that is a real
/// number; null if it has none. The others are in its menu.
const PolicyParameter* header_parameter(const LaneSettings& settings) {
  for (const PolicyParameterId key : policy(settings.policy.kind).parameters) {
    const PolicyParameter& row = policy_parameter(key);
    if (std::holds_alternative<RealParameter>(row.value)) {
      return &row;
    }
  }
  return nullptr;
}

// A parameter in the menu of the policy. Each returns whether it was changed.

bool edit_value(Ui& ui, const std::string& label, const std::string&,
                const CountParameter& parameter, Policy& policy) {
  int value = policy.*parameter.member;
  ImGui::SetNextItemWidth(ui.px(110.0f));
  const bool changed = ImGui::InputInt(label.c_str(), &value, 0);
  if (changed) {
    policy.*parameter.member = std::uint16_t(std::clamp<int>(value, parameter.low, parameter.high));
  }
  return changed;
}

bool edit_value(Ui& ui, const std::string& label, const std::string& name,
                const RealParameter& parameter, Policy& policy) {
  ImGui::TextUnformatted(label.c_str());
  ImGui::SameLine();
  return number_field(ui, name, policy.*parameter.member, parameter.low, parameter.high, "%.2f",
                      ui.px(110.0f));
}

bool edit_value(Ui&, const std::string& label, const std::string&, const FlagParameter& parameter,
                Policy& policy) {
  return ImGui::Checkbox(label.c_str(), &(policy.*parameter.member));
}

bool edit_parameters(Ui& ui, const std::string& name, LaneSettings& settings) {
  bool changed = false;
  const PolicyParameter* const elsewhere = header_parameter(settings);
  for (const PolicyParameterId key : policy(settings.policy.kind).parameters) {
    const PolicyParameter& row = policy_parameter(key);
    if (&row == elsewhere) {
      continue;
    }
    const std::string row_name = fmt::format("{}.{}", name, row.id);
    std::visit(
        [&](const auto& value) {
          changed |= edit_value(ui, std::string(row.label), row_name, value, settings.policy);
        },
        row.value);
    ui.mark(row_name);
    tooltip(ui, std::string(row.tooltip));
  }
  return changed;
}

}  // namespace

bool edit_policy(Ui& ui, std::size_t lane, LaneSettings& settings, float width) {
  const std::string name = fmt::format("lane{}.policy", lane);
  const bool chosen = combo(ui, name, std::string(policy(settings.policy.kind).label), width, [&] {
    bool changed = table_rows(ui, name, policies(), settings.policy.kind, &PolicyRow::source);
    ImGui::Separator();
    changed |= edit_parameters(ui, name, settings);
    int cap = int(std::min<std::uint32_t>(settings.max_spp, 1u << 30));
    ImGui::SetNextItemWidth(ui.px(110.0f));
    if (ImGui::InputInt("maximum spp", &cap, 0) && cap >= 1) {
      settings.max_spp = std::uint32_t(cap);
      changed = true;
    }
    ui.mark(name + ".max_spp");
    return changed;
  });
  tooltip(ui, "How errors become sample counts, by " +
                  std::string(policy(settings.policy.kind).source));
  return chosen;
}

bool edit_header_parameter(Ui& ui, std::size_t lane, LaneSettings& settings, ScreenRect box) {
  const PolicyParameter* const row = header_parameter(settings);
  if (row == nullptr) {
    return false;
  }
  const auto& parameter = std::get<RealParameter>(row->value);
  const std::string name = fmt::format("lane{}.{}", lane, row->id);
  const std::string label(row->label);
  const float field = ui.px(40.0f);
  const float gap = ui.px(4.0f);
  const float indent = text_width(ui.body, label) + gap;
  text_at(ui.body, box.x, box.y + ui.px(4.0f), palette::dim, label);
  ImGui::SetCursorScreenPos({box.x + indent, box.y});
  float& value = settings.policy.*parameter.member;
  const float track = box.width - field - gap - indent;
  bool changed = false;
  if (track >= ui.px(shortest_slider)) {
    changed = slider(ui, name, value, {parameter.low, parameter.usual_high}, track,
                     estimator_color(settings.estimator));
    tooltip(ui, std::string(row->tooltip));
  }
  ImGui::SetCursorScreenPos({box.right() - field, box.y});
  changed |=
      number_field(ui, name + ".number", value, parameter.low, parameter.high, "%.2f", field);
  return changed;
}

}  // namespace quartet
