#include "renderer/view/views/view_parts.h"

#include <fmt/format.h>

#include <utility>

namespace quartet {

View blank_view(const Snapshot& snapshot, std::string note) {
  View view;
  view.image = DisplayImage(snapshot.width, snapshot.height, not_a_number_color);
  view.note = std::move(note);
  return view;
}

View numbers_view(const Snapshot& snapshot, std::span<const float> numbers, ColorBar bar) {
  View view;
  view.image = DisplayImage(snapshot.width, snapshot.height);
  apply(numbers, bar.scale, view.image.pixels());
  view.bar = std::move(bar);
  return view;
}

std::vector<std::string> lines_of(glm::vec3 values) {
  return {short_number(values.r), short_number(values.g), short_number(values.b)};
}

std::vector<std::string> count_lines(const Snapshot& snapshot, std::size_t lane,
                                     const ViewSettings&, std::size_t pixel) {
  return {fmt::format("{}", snapshot.lanes[lane].taken[pixel])};
}

}  // namespace quartet
