#include "ui/window/lane_column.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/view/lane_charts.h"
#include "ui/widgets/chart_painter.h"
#include "ui/window/lane_header.h"
#include "ui/window/pictures/color_key.h"
#include "ui/window/pictures/picture_slot.h"

namespace quartet {
namespace {

// Two texture slots a lane, and one more for the right side of the wipe.
constexpr std::size_t wipe_texture = 2 * lane_count;

/// What the axis spans that would else span `wanted`. A line that is dragged in the plot must find
/// its numbers where they were; with a slider the axis follows outwards, so that the line stays in
/// sight, but not back.
DecadeRange axis_of_errors(const LabState& state, std::size_t lane, const DecadeRange& wanted) {
  if (!state.held_axis || state.held_axis->lane != lane) {
    return wanted;
  }
  const HeldAxis& held = *state.held_axis;
  return held.by_marker ? held.decades : held.decades.with(wanted);
}

void hold_axis(LabFrame& frame, std::size_t lane, const DecadeRange& decades, bool by_marker) {
  std::optional<HeldAxis>& held = frame.state.held_axis;
  if (by_marker || holds_threshold(frame.ui, lane)) {
    held = {lane, decades, by_marker};
  } else if (held && held->lane == lane) {
    held.reset();
  }
}

void draw_charts(LabFrame& frame, std::size_t lane, const ColumnLayout& layout) {
  const LaneSnapshot* const shown = frame.lane(lane);
  if (!shown) {
    return;
  }
  const Rgba8 accent = rgba_of(frame.lane_color(lane));
  const std::string name = fmt::format("lane{}.", lane);
  // Ahead of the lane while one is dragged; of another estimator they would mean nothing here.
  LaneSettings& wanted = frame.state.request.lanes.settings[lane];
  const Thresholds& thresholds = wanted.estimator == shown->settings.estimator
                                     ? wanted.thresholds
                                     : shown->settings.thresholds;
  const DecadeRange decades = axis_of_errors(frame.state, lane, error_decades(*shown, thresholds));
  const Chart errors = error_chart(*frame.snapshot, lane, thresholds, accent, decades);
  const auto drag = paint_chart(frame.ui, name + "errors", errors, layout.charts[0]);
  if (drag && wanted.estimator == shown->settings.estimator) {
    wanted.thresholds[std::size_t(drag->id)] = float(drag->value);
  }
  hold_axis(frame, lane, decades, drag.has_value());
  const ColorScale scale = heat_scale(*frame.snapshot, lane, frame.state.view.heat);
  paint_chart(frame.ui, name + "samples", sample_chart(*frame.snapshot, lane, scale),
              layout.charts[1]);
  paint_chart(frame.ui, name + "progress", progress_chart(*frame.snapshot, lane, accent),
              layout.charts[2]);
}

}  // namespace

ColumnWish column_wish(const LabFrame& frame) {
  ColumnWish wish;
  const RenderSettings& settings = frame.state.request.store.settings;
  if (settings.width > 0 && settings.height > 0) {
    wish.aspect = float(settings.width) / float(settings.height);
  }
  for (std::size_t slot = 0; slot < 2; ++slot) {
    for (const LaneSlots& slots : frame.state.slots) {
      wish.key_heights[slot] =
          std::max(wish.key_heights[slot], color_key_height(frame.ui, slots[slot].kind));
    }
  }
  return wish;
}

void draw_lane_column(LabFrame& frame, std::size_t lane, const ColumnLayout& layout) {
  ImGui::PushID(int(lane));
  const ScreenRect& panel = layout.panel;
  ImGui::GetWindowDrawList()->AddRectFilled(
      {panel.x, panel.y}, {panel.right(), panel.y + frame.ui.px(3.0f)}, frame.lane_color(lane));
  draw_lane_header(frame, lane, layout.header);
  const std::size_t source = frame.state.hold_first ? 0 : lane;
  const bool wipe = frame.state.layout == LabLayout::large && frame.state.comparison.wipe;
  for (std::size_t slot = 0; slot < 2; ++slot) {
    const PictureSlot picture{lane,     slot, source, 2 * lane + slot, layout.pictures[slot],
                              slot == 0};
    if (wipe && slot == 0) {
      PictureSlot other = picture;
      other.source = frame.state.comparison.other;
      other.texture = wipe_texture;
      draw_wipe_slot(frame, picture, other);
    } else {
      draw_picture_slot(frame, picture);
    }
    draw_color_key(frame, picture, layout.keys[slot]);
  }
  draw_charts(frame, lane, layout);
  ImGui::PopID();
}

}  // namespace quartet
