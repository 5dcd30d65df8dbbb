#include "renderer/view/views/view_parts.h"
#include "renderer/view/views/view_rows.h"

namespace quartet {
namespace {

View draw_reference(const Snapshot& snapshot, std::size_t, const ViewSettings& settings) {
  View view;
  view.image = to_display(*snapshot.reference, settings.exposure, settings.tone_map);
  return view;
}

std::vector<std::string> reference_lines(const Snapshot& snapshot, std::size_t, const ViewSettings&,
                                         std::size_t pixel) {
  return lines_of(snapshot.reference->pixels()[pixel]);
}

}  // namespace

constexpr ViewRow reference_view{.key = ViewKind::reference,
                                 .id = "reference",
                                 .label = "Reference",
                                 .quantity = "",
                                 .needs = {.reference = true, .tone_map = true},
                                 .draw = draw_reference,
                                 .lines = reference_lines};

}  // namespace quartet
