#include <fmt/format.h>

#include "renderer/adaptive/pixel_state.h"
#include "renderer/view/views/view_parts.h"
#include "renderer/view/views/view_rows.h"

namespace quartet {
namespace {

View draw_stop_state(const Snapshot& snapshot, std::size_t lane, const ViewSettings&) {
  const LaneSnapshot& shown = snapshot.lanes[lane];
  const std::uint32_t minimum = minimum_samples(shown.settings);
  std::string refining(pixel_state_label(PixelState::refining));
  if (estimator(shown.settings.estimator).channels > 0) {
    refining += ": error above its threshold";
    refining += minimum > 0 ? fmt::format(" or below {} spp", minimum) : "";
  }
  View view;
  // In the order of the states.
  view.legend = {{{46, 88, 130}, std::string(pixel_state_label(PixelState::done))},
                 {{232, 119, 46}, std::move(refining)},
                 {cap_color, fmt::format("{} of {} spp", pixel_state_label(PixelState::at_maximum),
                                         shown.settings.max_spp)}};
  view.image = DisplayImage(snapshot.width, snapshot.height);
  const std::vector<PixelState> states = pixel_states(shown);
  for (std::size_t i = 0; i < states.size(); ++i) {
    ColorMeaning& meaning = view.legend[std::size_t(states[i])];
    ++meaning.pixels;
    view.image.pixels()[i] = meaning.color;
  }
  return view;
}

}  // namespace

constexpr ViewRow stop_state_view{.key = ViewKind::stop_state,
                                  .id = "stop",
                                  .label = "Stop state",
                                  .quantity = "",
                                  .has_legend = true,
                                  .draw = draw_stop_state,
                                  .lines = count_lines};

}  // namespace quartet
