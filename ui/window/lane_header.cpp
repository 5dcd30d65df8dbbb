#include "ui/window/lane_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/adaptive/effort.h"
#include "renderer/base/number_text.h"
#include "renderer/measure/metrics.h"
#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/table_combo.h"
#include "ui/widgets/widgets.h"
#include "ui/window/policy_editor.h"

namespace quartet {
namespace {

constexpr std::array channel_names{"R", "G", "B"};

float row_height(const Ui& ui) {
  return font_size(ui.body) + ui.px(12.0f);
}

bool is_wide(const Ui& ui, float width) {
  return width > ui.px(600.0f);
}

std::string lane_name(std::size_t lane, const char* what) {
  return fmt::format("lane{}.{}", lane, what);
}

/// Another estimator brings its thresholds, and its policy unless another than the old one's was
/// chosen.
void choose_estimator(const Estimator& row, LaneSettings& settings) {
  if (settings.policy.kind == estimator(settings.estimator).default_policy) {
    settings.policy.kind = row.default_policy;
  }
  settings.estimator = row.key;
  settings.thresholds = row.default_thresholds;
}

bool edit_estimator(Ui& ui, std::size_t lane, LaneSettings& settings, bool has_reference,
                    float width) {
  const std::string name = lane_name(lane, "estimator");
  return combo(ui, name, std::string(estimator(settings.estimator).label), width, [&] {
    bool changed = false;
    for (const Estimator& row : estimators()) {
      if (row.needs_reference && !has_reference) {
        ImGui::TextDisabled("%s: needs a reference", std::string(row.label).c_str());
        continue;
      }
      if (combo_row(ui, fmt::format("{}.{}", name, row.id), std::string(row.label),
                    settings.estimator == row.key, std::string(row.source))) {
        choose_estimator(row, settings);
        changed = true;
      }
    }
    return changed;
  });
}

bool edit_sample_mode(Ui& ui, std::size_t lane, LaneSettings& settings, float width) {
  const std::string name = lane_name(lane, "mode");
  const bool chosen = combo(ui, name, std::string(sample_mode(settings.mode).label), width, [&] {
    return table_rows(ui, name, sample_modes(), settings.mode, &SampleModeRow::source);
  });
  tooltip(ui, "What becomes of the samples that decide where more are taken: " +
                  std::string(sample_mode(settings.mode).source) + ".");
  return chosen;
}

/// Of a combo box that holds any label of a table.
template <class Row>
float widest_combo(const Ui& ui, std::span<const Row> table) {
  float widest = 0.0f;
  for (const Row& row : table) {
    widest = std::max(widest, combo_width(ui, row.label));
  }
  return widest;
}

std::string source_text(const Estimator& row) {
  std::string numbers;
  for (int c = 0; c < row.channels; ++c) {
    numbers += (c > 0 ? ", " : "") + format_number(row.default_thresholds[std::size_t(c)]);
  }
  return fmt::format("Threshold of the error, in {}.\nDefault {}: {}.\nFormula: {}.", row.unit,
                     numbers, row.threshold_source, row.source);
}

/// Digits that show a threshold of this size and what a drag does to it.
const char* threshold_format(float value) {
  return value >= 0.1f ? "%.2f" : value >= 0.01f ? "%.3f" : value >= 0.001f ? "%.4f" : "%.2e";
}

bool edit_thresholds(Ui& ui, std::size_t lane, LaneSettings& settings, ScreenRect box) {
  const Estimator& row = estimator(settings.estimator);
  const float text_y = box.y + 0.5f * (ImGui::GetFrameHeight() - font_size(ui.body));
  if (row.channels == 0) {
    text_at(ui.body, box.x, text_y, palette::dim,
            fitting_text(ui.body, {"no threshold: every pixel alike", "no threshold"}, box.width));
    return false;
  }
  bool changed = false;
  const float reset = ImGui::GetFrameHeight() * 0.8f;
  ImGui::SetCursorScreenPos({box.right() - reset, box.y});
  if (icon_button(ui, lane_name(lane, "reset"), Icon::reset, true, reset)) {
    settings.thresholds = row.default_thresholds;
    changed = true;
  }
  tooltip(ui, "Back to the default.\n" + source_text(row));
  box.width -= reset + ui.px(2.0f);

  const bool one = row.channels == 1;
  const float field = ui.px(one ? 56.0f : 34.0f);
  const std::string unit(row.unit);
  const float unit_width = text_width(ui.small, unit) + ui.px(6.0f);
  const float part_gap = ui.px(one ? 6.0f : 3.0f);
  const auto slider_width = [&](float width) {
    const float part = (width - float(row.channels - 1) * part_gap) / float(row.channels);
    return part - field - (one ? text_width(ui.body, "threshold") + ui.px(8.0f) : ui.px(13.0f));
  };
  // The unit gives way first: the axis of the plot below says it as well.
  if (slider_width(box.width - unit_width) > ui.px(40.0f)) {
    text_left_of(ui.small, box.right(), text_y + ui.px(1.5f), palette::dim, unit);
    box.width -= unit_width;
  }
  const float part = (box.width - float(row.channels - 1) * part_gap) / float(row.channels);
  for (int c = 0; c < row.channels; ++c) {
    const auto channel = std::size_t(c);
    float x = box.x + float(c) * (part + part_gap);
    const ImU32 color = one ? estimator_color(row.key) : palette::channels[channel];
    const std::string label = one ? "threshold" : channel_names[channel];
    text_at(one ? ui.body : ui.bold, x, text_y, one ? palette::dim : color, label);
    x += one ? text_width(ui.body, label) + ui.px(8.0f) : ui.px(13.0f);
    const ThresholdRange range = threshold_range(row, channel);
    float& value = settings.thresholds[channel];
    const std::string name = fmt::format("lane{}.threshold{}", lane, c);
    const float width = slider_width(box.width);
    ImGui::SetCursorScreenPos({x, box.y});
    if (width >= ui.px(shortest_slider)) {
      changed |= slider(ui, name, value, {range.low, range.high, true}, width, color);
      tooltip(ui, source_text(row));
      ImGui::SetCursorScreenPos({x + width, box.y});
    }
    changed |=
        number_field(ui, name + ".number", value, 1e-9f, 1e9f, threshold_format(value), field);
    tooltip(ui, source_text(row));
  }
  return changed;
}

std::string mean_spp_text(const LabFrame& frame, const LaneSnapshot& lane) {
  const double mean = mean_spp(lane.history.back(), frame.snapshot->pixels());
  return mean < 1000.0 ? fmt::format("{:.1f} spp", mean) : fmt::format("{:.0f} spp", mean);
}

void draw_mean(LabFrame& frame, std::size_t lane, float right, float y) {
  const LaneSnapshot* const shown = frame.lane(lane);
  if (shown && !shown->history.empty()) {
    text_left_of(frame.ui.bold, right, y, palette::text, mean_spp_text(frame, *shown));
  }
}

void draw_numbers(LabFrame& frame, std::size_t lane, const ScreenRect& box, bool right_aligned) {
  const LaneSnapshot* const shown = frame.lane(lane);
  if (!shown || shown->history.empty()) {
    return;
  }
  const PassRecord& last = shown->history.back();
  const double share = 100.0 * double(last.not_done) / double(frame.snapshot->pixels());
  const std::string seconds = last.seconds < 100.0 ? fmt::format("{:.2f} s", last.seconds)
                                                   : fmt::format("{:.0f} s", last.seconds);
  const std::uint64_t rejected = shown->rejected.empty() ? 0 : [&] {
    std::uint64_t sum = 0;
    for (const std::uint32_t count : shown->rejected) {
      sum += count;
    }
    return sum;
  }();
  const std::string bad = rejected > 0 ? fmt::format(" · {} rejected", rejected) : "";
  const Metric& row = metric(frame.snapshot->metric);
  const std::string error = std::isnan(last.truth.error + last.truth.energy)
                                ? ""
                                : fmt::format(" · {} {:.3g}, energy {:+.1f} %", row.label,
                                              last.truth.error, 100.0 * last.truth.energy);
  const std::string text = fitting_text(
      frame.ui.small,
      {fmt::format("max {} spp · {} as if alone · {:.1f} % not done{}{}", last.max_spp, seconds,
                   share, error, bad),
       fmt::format("max {} · {} · {:.0f} %{}{}", last.max_spp, seconds, share, error, bad),
       fmt::format("max {} spp · {} as if alone · {:.1f} % not done{}", last.max_spp, seconds,
                   share, bad),
       fmt::format("max {} · {} as if alone · {:.1f} % not done{}", last.max_spp, seconds, share,
                   bad),
       fmt::format("max {} · {} alone · {:.0f} % not done{}", last.max_spp, seconds, share, bad),
       fmt::format("max {} · {} · {:.0f} %{}", last.max_spp, seconds, share, bad)},
      box.width);
  const float width = text_width(frame.ui.small, text);
  const float x = right_aligned ? box.right() - width : box.x;
  ImGui::SetCursorScreenPos({x, box.y});
  invisible_button(lane_name(lane, "numbers"), {width, font_size(frame.ui.small)});
  frame.ui.mark(lane_name(lane, "numbers"));
  const std::string pilot =
      last.pilot_samples == 0
          ? ""
          : fmt::format("\nHalf of its {} samples are of the pilot run, which is not shown.",
                        last.samples);
  tooltip(frame.ui, fmt::format("Highest samples of a pixel: {}.\nSeconds that this lane would "
                                "have taken alone, samples, estimates and plans: {:.3f}.\nRays of "
                                "its samples: {}, {:.1f} a pixel.\nPixels not done: {} of "
                                "{}.\nSamples rejected, negative or not "
                                "finite: {}.{}",
                                last.max_spp, last.seconds, last.rays,
                                mean_rays(last, frame.snapshot->pixels()), last.not_done,
                                frame.snapshot->pixels(), rejected, pilot));
  text_at(frame.ui.small, x, box.y, rejected > 0 ? palette::error : palette::dim, text);
}

}  // namespace

ThresholdRange threshold_range(const Estimator& row, std::size_t channel) {
  const float middle = row.default_thresholds[channel];
  return {middle * 0.01f, std::min(middle * 100.0f, std::max(1.0f, 2.0f * middle))};
}

bool holds_threshold(const Ui& ui, std::size_t lane) {
  return ui.held.starts_with(lane_name(lane, "threshold"));
}

float lane_header_height(const Ui& ui, float width) {
  const float rows = is_wide(ui, width) ? 2.0f : 3.0f;
  const float numbers = is_wide(ui, width) ? 0.0f : font_size(ui.small) + ui.px(7.0f);
  return rows * row_height(ui) + numbers;
}

void draw_lane_header(LabFrame& frame, std::size_t lane, ScreenRect box) {
  Ui& ui = frame.ui;
  LaneSettings edited = frame.state.request.lanes.settings[lane];
  bool changed = false;
  const float gap = ui.px(8.0f);
  const float row = row_height(ui);
  const float mean_width = ui.px(76.0f);
  const float estimator_width = widest_combo(ui, estimators());
  const bool has_reference = frame.state.request.lanes.reference != nullptr;
  ScreenRect first = box.cut_top(row);
  draw_mean(frame, lane, first.right(), first.y + ui.px(3.0f));
  first.cut_right(mean_width);
  ImGui::SetCursorScreenPos({first.x, first.y});
  changed |=
      edit_estimator(ui, lane, edited, has_reference, std::min(first.width, estimator_width));
  tooltip(ui, std::string(estimator(edited.estimator).source));
  if (is_wide(ui, box.width)) {
    const float policy_width = widest_combo(ui, policies());
    const float mode_width = widest_combo(ui, sample_modes());
    first.cut_left(estimator_width + gap);
    ImGui::SetCursorScreenPos({first.x, first.y});
    changed |= edit_policy(ui, lane, edited, policy_width);
    first.cut_left(policy_width + gap);
    ImGui::SetCursorScreenPos({first.x, first.y});
    changed |= edit_sample_mode(ui, lane, edited, mode_width);
    first.cut_left(mode_width + gap);
    changed |= edit_header_parameter(ui, lane, edited, first.cut_left(ui.px(160.0f)));
    ScreenRect second = box.cut_top(row);
    // Of the usual numbers, not of these: a slider that grew as they change would move under the
    // mouse that drags it.
    const float usual = text_width(ui.small, "max 888 spp · 88.88 s as if alone · 88.8 % not done");
    ScreenRect numbers = second.cut_right(std::min(usual, 0.5f * second.width));
    numbers.y += ui.px(6.0f);
    draw_numbers(frame, lane, numbers, true);
    second.cut_right(2 * gap);
    changed |= edit_thresholds(ui, lane, edited, second);
  } else {
    ScreenRect second = box.cut_top(row);
    // No wider than what they show: the multiplier needs the room.
    float policy_width = combo_width(ui, policy(edited.policy.kind).label);
    float mode_width = combo_width(ui, sample_mode(edited.mode).label);
    // And in a narrow column its number does.
    const float room = std::max(0.0f, second.width - 1.5f * gap - ui.px(60.0f));
    const float share = std::min(1.0f, room / (policy_width + mode_width));
    policy_width *= share;
    mode_width *= share;
    ImGui::SetCursorScreenPos({second.x, second.y});
    changed |= edit_policy(ui, lane, edited, policy_width);
    second.cut_left(policy_width + 0.5f * gap);
    ImGui::SetCursorScreenPos({second.x, second.y});
    changed |= edit_sample_mode(ui, lane, edited, mode_width);
    second.cut_left(mode_width + gap);
    changed |= edit_header_parameter(ui, lane, edited, second);
    changed |= edit_thresholds(ui, lane, edited, box.cut_top(row));
    draw_numbers(frame, lane, box, false);
  }
  if (changed) {
    frame.state.request.lanes.settings[lane] = edited;
  }
}

}  // namespace quartet
