#include <fmt/format.h>

#include <algorithm>

#include "renderer/view/views/view_parts.h"
#include "renderer/view/views/view_rows.h"

namespace quartet {
namespace {

View draw_heatmap(const Snapshot& snapshot, std::size_t lane, const ViewSettings& settings) {
  const LaneSnapshot& shown = snapshot.lanes[lane];
  const std::uint32_t cap = shown.settings.max_spp;
  View view;
  view.bar = {heat_scale(snapshot, lane, settings.heat), "", ""};
  if (!shown.history.empty() && shown.history.back().max_spp >= cap) {
    view.bar->cap_label = fmt::format("the maximum of {} spp", cap);
  }
  view.image = DisplayImage(snapshot.width, snapshot.height);
  heatmap(shown.taken, view.bar->scale, cap, view.image.pixels());
  return view;
}

}  // namespace

constexpr ViewRow heatmap_view{.key = ViewKind::heatmap,
                               .id = "heatmap",
                               .label = "Samples",
                               .quantity = "samples per pixel",
                               .has_bar = true,
                               .needs = {.heat_range = true},
                               .draw = draw_heatmap,
                               .lines = count_lines};

ColorScale heat_scale(const Snapshot& snapshot, std::size_t lane, HeatRange range) {
  if (range == HeatRange::report) {
    const auto [low, high] = std::ranges::minmax_element(snapshot.lanes[lane].taken);
    return {double(*low), double(*high), ColorMapId::report};
  }
  std::uint32_t highest = 1;
  for (const LaneSnapshot& each : snapshot.lanes) {
    highest = std::max(highest, each.history.empty() ? 0 : each.history.back().max_spp);
  }
  return {0.0, double(highest), ColorMapId::turbo};
}

}  // namespace quartet
