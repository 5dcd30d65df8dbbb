#include "renderer/measure/metrics.h"
#include "renderer/view/pixel_values.h"
#include "renderer/view/views/view_parts.h"
#include "renderer/view/views/view_rows.h"

namespace quartet {
namespace {

/// On a scale that depends on nothing, so that a colour means the same in every lane, at every
/// pass: from errors that are not seen to as large as the picture itself.
View draw_true_error(const Snapshot& snapshot, std::size_t lane, const ViewSettings&) {
  const ScalarImage map =
      metric(MetricId::relmse).map(radiance_image(snapshot, lane), *snapshot.reference);
  return numbers_view(snapshot, map.pixels(),
                      {{1e-6, 1.0, ColorMapId::viridis, Spacing::logarithmic}, "", ""});
}

std::vector<std::string> true_error_lines(const Snapshot& snapshot, std::size_t lane,
                                          const ViewSettings&, std::size_t pixel) {
  const glm::vec3 truth = snapshot.reference->pixels()[pixel];
  const glm::vec3 off = pixel_values(snapshot.lanes[lane], pixel).radiance - truth;
  return lines_of(off * off / (truth * truth + 0.01f));
}

}  // namespace

constexpr ViewRow true_error_view{
    .key = ViewKind::true_error,
    .id = "true-error",
    .label = "True error",
    .quantity = "relative squared error against the reference, (x − r)² / (r² + 0.01)",
    .has_bar = true,
    .needs = {.reference = true},
    .draw = draw_true_error,
    .lines = true_error_lines};

}  // namespace quartet
