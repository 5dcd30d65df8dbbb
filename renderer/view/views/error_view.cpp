#include "renderer/adaptive/pixel_state.h"
#include "renderer/view/pixel_values.h"
#include "renderer/view/views/view_parts.h"
#include "renderer/view/views/view_rows.h"

namespace quartet {
namespace {

/// Linear from 0 to twice the threshold, so that what decides lies in the middle of the scale; how
/// far beyond it an error is, its histogram shows.
View draw_error(const Snapshot& snapshot, std::size_t lane, const ViewSettings&) {
  const std::vector<float> scaled = largest_scaled_errors(snapshot.lanes[lane]);
  if (scaled.empty()) {
    return blank_view(snapshot, estimator(snapshot.lanes[lane].settings.estimator).channels == 0
                                    ? "uniform sampling estimates no error"
                                    : "no pass yet");
  }
  return numbers_view(snapshot, scaled, {{0.0, 2.0, ColorMapId::turbo}, "", ""});
}

std::vector<std::string> error_lines(const Snapshot& snapshot, std::size_t lane,
                                     const ViewSettings&, std::size_t pixel) {
  const PixelValues values = pixel_values(snapshot.lanes[lane], pixel);
  return values.error_channels > 0 ? std::vector{short_number(values.scaled_error)}
                                   : std::vector<std::string>{};
}

}  // namespace

constexpr ViewRow error_view{.key = ViewKind::error,
                             .id = "error",
                             .label = "Error",
                             .quantity = "error / threshold",
                             .has_bar = true,
                             .draw = draw_error,
                             .lines = error_lines};

}  // namespace quartet
