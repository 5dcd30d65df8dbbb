#include "renderer/view/views.h"

#include "renderer/base/table.h"
#include "renderer/view/views/view_parts.h"
#include "renderer/view/views/view_rows.h"

namespace quartet {
namespace {

const ViewRow* row_of_view(ViewKind key) {
  switch (key) {
    case ViewKind::image:
      return &image_view;
    case ViewKind::heatmap:
      return &heatmap_view;
    case ViewKind::error:
      return &error_view;
    case ViewKind::variance:
      return &variance_view;
    case ViewKind::stop_state:
      return &stop_state_view;
    case ViewKind::rejected:
      return &rejected_view;
    case ViewKind::difference:
      return &difference_view;
    case ViewKind::true_error:
      return &true_error_view;
    case ViewKind::reference:
      return &reference_view;
  }
  return nullptr;
}

/// Why a view has nothing to show; null if it has what it needs.
const char* lacking(const ViewRow& row, const Snapshot& snapshot, std::size_t lane) {
  if (row.needs.reference && !snapshot.reference) {
    return "there is no reference for this view";
  }
  if (row.needs.variance && snapshot.lanes[lane].variance.empty()) {
    return "the variance was not asked for";
  }
  return nullptr;
}

}  // namespace

std::span<const ViewRow> views() {
  static const std::vector<ViewRow> table = table_of(row_of_view);
  return table;
}

const ViewRow& view_row(ViewKind key) {
  return row_of(views(), key);
}

const ViewRow& find_view(std::string_view id) {
  return find_row(views(), id, "view");
}

View draw_view(const Snapshot& snapshot, std::size_t lane, ViewKind kind,
               const ViewSettings& settings) {
  const ViewRow& row = view_row(kind);
  if (const char* const reason = lacking(row, snapshot, lane)) {
    return blank_view(snapshot, reason);
  }
  View view = row.draw(snapshot, lane, settings);
  if (view.bar && view.bar->label.empty()) {
    view.bar->label = row.quantity;
  }
  return view;
}

std::vector<std::string> pixel_lines(const Snapshot& snapshot, std::size_t lane, ViewKind kind,
                                     const ViewSettings& settings, std::size_t pixel) {
  const ViewRow& row = view_row(kind);
  return lacking(row, snapshot, lane) ? std::vector<std::string>()
                                      : row.lines(snapshot, lane, settings, pixel);
}

}  // namespace quartet
