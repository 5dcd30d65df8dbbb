#include "ui/window/toolbar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/table_combo.h"
#include "ui/widgets/widgets.h"
#include "ui/window/lab_layout.h"
#include "ui/window/menus/scene_menu.h"
#include "ui/window/menus/view_controls.h"

namespace quartet {
namespace {

constexpr float toolbar_row = 32.0f;
constexpr float toolbar_margin = 8.0f;

/// One control: how wide it is, and what draws it at the cursor.
struct Item {
  float width;
  void (*draw)(LabFrame& frame, float width);
  bool stretch = false;    ///< takes what is left of its row
  bool new_group = false;  ///< stands a little apart from the one before
};

void draw_integrator(LabFrame& frame, float width) {
  RenderSettings& settings = frame.state.request.store.settings;
  combo(frame.ui, "integrator", std::string(integrator(settings.integrator).id), width, [&] {
    return table_rows(frame.ui, "integrator", integrators(), settings.integrator,
                      &Integrator::description);
  });
  tooltip(frame.ui, std::string(integrator(settings.integrator).description));
}

void draw_sampler(LabFrame& frame, float width) {
  RenderSettings& settings = frame.state.request.store.settings;
  combo(frame.ui, "sampler", std::string(sampler_row(settings.sampler).id), width, [&] {
    return table_rows(frame.ui, "sampler", samplers(), settings.sampler, &SamplerRow::description);
  });
  if (const TraceScene* scene = frame.state.trace_scene()) {
    settings.sampler = sampler_for(scene->scene(), settings.sampler);
  }
  const SamplerRow& row = sampler_row(settings.sampler);
  tooltip(frame.ui, fmt::format("{}. Variance: {}", row.description, row.variance));
}

std::string size_text(int width, int height) {
  return fmt::format("{} × {}", width, height);
}

void draw_size(LabFrame& frame, float width) {
  LabState& state = frame.state;
  RenderSettings& settings = state.request.store.settings;
  combo(frame.ui, "size", size_text(settings.width, settings.height), width, [&] {
    bool changed = false;
    const TraceScene* scene = state.trace_scene();
    const int own_width = scene ? scene->scene().width : settings.width;
    const int own_height = scene ? scene->scene().height : settings.height;
    for (const double factor : {0.25, 0.5, 1.0, 2.0}) {
      const int w = std::max(1, int(std::lround(factor * own_width)));
      const int h = std::max(1, int(std::lround(factor * own_height)));
      const std::string text = size_text(w, h) + (factor == 1.0 ? "   the scene's own" : "");
      if (combo_row(frame.ui, fmt::format("size.{}", w), text,
                    w == settings.width && h == settings.height)) {
        settings.width = w;
        settings.height = h;
        changed = true;
      }
    }
    ImGui::Separator();
    std::array<int, 2> typed{settings.width, settings.height};
    ImGui::SetNextItemWidth(frame.ui.px(150.0f));
    if (ImGui::InputInt2("pixels", typed.data(), ImGuiInputTextFlags_EnterReturnsTrue)) {
      // A picture of four lanes this large is some gigabytes.
      settings.width = std::clamp(typed[0], 1, 8192);
      settings.height = std::clamp(typed[1], 1, 8192);
      changed = true;
    }
    return changed;
  });
  tooltip(frame.ui, "Resolution: other pixels, so all samples are traced anew");
}

void draw_seed(LabFrame& frame, float width) {
  const float start = ImGui::GetCursorScreenPos().x;
  leading_label(frame.ui, "seed");
  ImGui::SetNextItemWidth(width - (ImGui::GetCursorScreenPos().x - start));
  std::uint64_t seed = frame.state.request.store.settings.seed;
  constexpr std::uint64_t least = 0;
  constexpr std::uint64_t largest = UINT64_MAX;
  if (ImGui::DragScalar("##seed", ImGuiDataType_U64, &seed, 0.05f, &least, &largest)) {
    frame.state.request.store.settings.seed = seed;
  }
  frame.ui.mark("seed");
  tooltip(frame.ui, "Another seed, other random numbers. Drag, or double-click and type.");
}

void draw_transport(LabFrame& frame, float) {
  Playback& playback = frame.state.playback;
  Ui& ui = frame.ui;
  const auto next = [&] { ImGui::SameLine(0.0f, ui.px(4.0f)); };
  if (icon_button(ui, "to_start", Icon::to_start)) {
    playback.seek(1);
  }
  tooltip(ui, "First pass");
  next();
  if (icon_button(ui, "back", Icon::back, playback.shown() > 1)) {
    playback.step(-1);
  }
  tooltip(ui, "One pass back  ( , )");
  next();
  const bool at_end = playback.playing() && playback.shown() >= playback.target();
  const bool running = playback.playing() && !at_end;
  if (icon_button(ui, "play", running ? Icon::pause : Icon::play)) {
    at_end ? playback.play() : playback.toggle();
  }
  tooltip(ui, running ? "Pause  (Space)" : "Play  (Space)");
  next();
  if (icon_button(ui, "forward", Icon::forward)) {
    playback.step(1);
  }
  tooltip(ui, "One pass forward  ( . )");
  next();
  if (icon_button(ui, "restart", Icon::restart)) {
    playback.restart();
  }
  tooltip(ui, "Play again from the first pass  (P)");
}

float transport_width(const Ui& ui) {
  return 5 * 1.15f * ImGui::GetFrameHeight() + 4 * ui.px(4.0f);
}

std::string pass_text(const Playback& playback) {
  const std::string target = playback.target() == Playback::no_end
                                 ? std::string("∞")
                                 : fmt::format("{}", playback.target());
  return fmt::format("{} / {}", playback.shown(), target);
}

void draw_pass_slider(LabFrame& frame, float width) {
  Playback& playback = frame.state.playback;
  Ui& ui = frame.ui;
  const float start = ImGui::GetCursorScreenPos().x;
  leading_label(ui, "pass");
  const float text = std::max(ui.px(52.0f), text_width(ui.body, pass_text(playback)) + ui.px(8.0f));
  std::uint32_t last = std::max(playback.furthest(), playback.shown());
  if (playback.target() != Playback::no_end) {
    last = std::max(last, playback.target());
  }
  last = std::max(last, 2u);
  float at = float(playback.playing() ? std::max(1u, playback.shown()) : playback.wanted());
  const float track = width - (ImGui::GetCursorScreenPos().x - start) - text;
  if (slider(ui, "pass", at, {1.0f, float(last)}, track, palette::text)) {
    playback.seek(std::uint32_t(std::lround(at)));
  }
  tooltip(ui, "Scrub: the lanes replay to this pass");
  const ImVec2 knob_row = ImGui::GetItemRectMin();
  text_at(ui.body, ImGui::GetItemRectMax().x + ui.px(6.0f),
          knob_row.y + 0.5f * (ImGui::GetFrameHeight() - font_size(ui.body)), palette::text,
          pass_text(playback));
}

void draw_target(LabFrame& frame, float width) {
  Playback& playback = frame.state.playback;
  const float start = ImGui::GetCursorScreenPos().x;
  leading_label(frame.ui, "to");
  width -= ImGui::GetCursorScreenPos().x - start;
  const auto text = [](std::uint32_t target) {
    return target == Playback::no_end ? std::string("∞") : fmt::format("{}", target);
  };
  combo(frame.ui, "target", text(playback.target()), width, [&] {
    bool changed = false;
    for (const std::uint32_t target : {15u, 30u, 60u, 120u, Playback::no_end}) {
      if (combo_row(frame.ui, "target." + text(target), text(target),
                    target == playback.target())) {
        playback.set_target(target);
        changed = true;
      }
    }
    return changed;
  });
  tooltip(frame.ui, "Passes to play: 15 as in the report, ∞ to go on until you pause");
}

void draw_export(LabFrame& frame, float width) {
  ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(44, 98, 190, 255));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, IM_COL32(56, 116, 216, 255));
  if (ImGui::Button("Export…", {width, 0.0f})) {
    frame.state.export_form.open = true;
  }
  frame.ui.mark("export");
  ImGui::PopStyleColor(2);
  tooltip(frame.ui, "Save the figure of all lanes, or one panel  (S)");
}

void draw_help_button(LabFrame& frame, float width) {
  if (ImGui::Button("?", {width, 0.0f})) {
    frame.state.help_open = true;
  }
  frame.ui.mark("help");
  tooltip(frame.ui, "All keys  (H)");
}

std::vector<Item> items(const LabFrame& frame, bool compact) {
  const Ui& ui = frame.ui;
  const LabState& state = frame.state;
  const auto labelled = [&](const char* text, float width) {
    return text_width(ui.body, text) + ui.px(6.0f) + width;
  };
  const auto exposure_width = [&] {
    return compact ? ui.px(100.0f) : labelled("exposure", ui.px(146.0f));
  };
  const RenderSettings& settings = state.request.store.settings;
  return {
      {std::max(ui.px(compact ? 80.0f : 140.0f), combo_width(ui, scene_label(state))), draw_scene},
      {combo_width(ui, "kajiya"), draw_integrator},
      {combo_width(ui, "independent"), draw_sampler},
      {combo_width(ui, size_text(settings.width, settings.height)), draw_size},
      {labelled("seed", ui.px(44.0f)), draw_seed},
      {transport_width(ui), draw_transport, false, true},
      {labelled("pass", ui.px(compact ? 90.0f : 110.0f)), draw_pass_slider, true},
      {labelled("to", combo_width(ui, compact ? "15" : "120")), draw_target},
      {exposure_width(), draw_exposure, false, true},
      {combo_width(ui, compact ? std::string(tone_map_row(state.view.tone_map).label) : "Reinhard"),
       draw_tone_map},
      {combo_width(ui, compact ? heat_label(state.view.heat) : "heat: report"), draw_heat},
      {combo_width(ui, compact ? std::string(layout_row(state.layout).label) : "one large"),
       draw_layout, false, true},
      {text_width(ui.body, "Export…") + ui.px(22.0f), draw_export},
      {ui.px(26.0f), draw_help_button},
  };
}

/// The controls, and where rows of them begin. Compact if that saves a row.
struct Rows {
  std::vector<Item> items;
  std::vector<std::size_t> starts{0};
  float gap = 0.0f;
  float group_gap = 0.0f;

  float gap_before(std::size_t item) const { return items[item].new_group ? group_gap : gap; }
};

Rows lay_out_rows(const LabFrame& frame, float width, bool compact) {
  Rows rows;
  rows.items = items(frame, compact);
  for (Item& item : rows.items) {
    item.width = std::min(item.width, std::max(1.0f, width));
  }
  rows.gap = frame.ui.px(compact ? 4.0f : 8.0f);
  rows.group_gap = frame.ui.px(compact ? 8.0f : 16.0f);
  float used = 0.0f;
  for (std::size_t i = 0; i < rows.items.size(); ++i) {
    const float before = i == rows.starts.back() ? 0.0f : rows.gap_before(i);
    if (used + before + rows.items[i].width > width && i > rows.starts.back()) {
      rows.starts.push_back(i);
      used = rows.items[i].width;
    } else {
      used += before + rows.items[i].width;
    }
  }
  return rows;
}

Rows best_rows(const LabFrame& frame, float width) {
  Rows rows = lay_out_rows(frame, width, false);
  if (rows.starts.size() > 1) {
    Rows compact = lay_out_rows(frame, width, true);
    if (compact.starts.size() < rows.starts.size()) {
      return compact;
    }
  }
  return rows;
}

}  // namespace

float toolbar_height(const LabFrame& frame, float width) {
  const Ui& ui = frame.ui;
  const auto rows = best_rows(frame, width - 2 * ui.px(toolbar_margin)).starts.size();
  return float(rows) * ui.px(toolbar_row) + ui.px(8.0f);
}

void draw_toolbar(LabFrame& frame, const ScreenRect& box) {
  const Ui& ui = frame.ui;
  const float width = box.width - 2 * ui.px(toolbar_margin);
  Rows rows = best_rows(frame, width);
  rows.starts.push_back(rows.items.size());
  float y = box.y + ui.px(4.0f) + 0.5f * (ui.px(toolbar_row) - ImGui::GetFrameHeight());
  for (std::size_t row = 0; row + 1 < rows.starts.size(); ++row) {
    const std::size_t first = rows.starts[row];
    const std::size_t end = rows.starts[row + 1];
    float needed = 0.0f;
    bool stretches = false;
    for (std::size_t i = first; i < end; ++i) {
      needed += rows.items[i].width + (i > first ? rows.gap_before(i) : 0.0f);
      stretches |= rows.items[i].stretch;
    }
    const float spare = stretches ? std::max(0.0f, width - needed) : 0.0f;
    float x = box.x + ui.px(toolbar_margin);
    for (std::size_t i = first; i < end; ++i) {
      x += i > first ? rows.gap_before(i) : 0.0f;
      ImGui::SetCursorScreenPos({x, y});
      const float item_width = rows.items[i].width + (rows.items[i].stretch ? spare : 0.0f);
      rows.items[i].draw(frame, item_width);
      x += item_width;
    }
    y += ui.px(toolbar_row);
  }
}

}  // namespace quartet
