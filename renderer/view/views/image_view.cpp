#include "renderer/view/pixel_values.h"
#include "renderer/view/views/view_parts.h"
#include "renderer/view/views/view_rows.h"

namespace quartet {
namespace {

View draw_image(const Snapshot& snapshot, std::size_t lane, const ViewSettings& settings) {
  View view;
  view.image = to_display(radiance_image(snapshot, lane), settings.exposure, settings.tone_map);
  return view;
}

std::vector<std::string> image_lines(const Snapshot& snapshot, std::size_t lane,
                                     const ViewSettings&, std::size_t pixel) {
  return lines_of(pixel_values(snapshot.lanes[lane], pixel).radiance);
}

}  // namespace

constexpr ViewRow image_view{.key = ViewKind::image,
                             .id = "image",
                             .label = "Image",
                             .quantity = "",
                             .needs = {.tone_map = true},
                             .draw = draw_image,
                             .lines = image_lines};

}  // namespace quartet
