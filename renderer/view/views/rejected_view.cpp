#include <fmt/format.h>

#include <algorithm>

#include "renderer/view/pixel_values.h"
#include "renderer/view/views/view_parts.h"
#include "renderer/view/views/view_rows.h"

namespace quartet {
namespace {

View draw_rejected(const Snapshot& snapshot, std::size_t lane, const ViewSettings&) {
  const std::vector<std::uint32_t>& rejected = snapshot.lanes[lane].rejected;
  std::uint32_t highest = 1;
  for (const LaneSnapshot& each : snapshot.lanes) {
    highest = std::max(highest, each.rejected.empty() ? 0 : std::ranges::max(each.rejected));
  }
  std::vector<float> counts(rejected.begin(), rejected.end());
  counts.resize(snapshot.pixels(), 0.0f);
  View view = numbers_view(snapshot, counts, {{0.0, double(highest), ColorMapId::viridis}, "", ""});
  if (rejected.empty()) {
    view.note = "no sample was rejected";
  }
  return view;
}

std::vector<std::string> rejected_lines(const Snapshot& snapshot, std::size_t lane,
                                        const ViewSettings&, std::size_t pixel) {
  return {fmt::format("{}", pixel_values(snapshot.lanes[lane], pixel).rejected)};
}

}  // namespace

constexpr ViewRow rejected_view{.key = ViewKind::rejected,
                                .id = "rejected",
                                .label = "Rejected",
                                .quantity = "rejected samples per pixel",
                                .has_bar = true,
                                .draw = draw_rejected,
                                .lines = rejected_lines};

}  // namespace quartet
