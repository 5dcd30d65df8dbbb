#include <cmath>
#include <utility>

#include "renderer/base/interval.h"
#include "renderer/view/pixel_values.h"
#include "renderer/view/views/view_parts.h"
#include "renderer/view/views/view_rows.h"

namespace quartet {
namespace {

/// Half of a scale that holds 19 in 20 of the numbers that are not 0; the rest is fireflies. 1, 2
/// or 5 times a power of ten, so that it stays when numbers change a little.
double symmetric_end(std::span<const float> numbers) {
  std::vector<float> sizes;
  sizes.reserve(numbers.size());
  for (const float number : numbers) {
    if (number != 0.0f) {
      sizes.push_back(std::abs(number));
    }
  }
  if (sizes.empty()) {
    return 1.0;
  }
  const std::size_t fireflies = sizes.size() / 20;
  const double size = double(largest_but(std::move(sizes), fireflies));
  const double power = std::pow(10.0, std::floor(std::log10(size)));
  const double digit = size / power;
  return power * (digit <= 1.0 ? 1.0 : digit <= 2.0 ? 2.0 : digit <= 5.0 ? 5.0 : 10.0);
}

View draw_difference(const Snapshot& snapshot, std::size_t lane, const ViewSettings& settings) {
  if (settings.other >= snapshot.lanes.size()) {
    return blank_view(snapshot, "there is no such lane to compare with");
  }
  const auto& a = snapshot.lanes[lane].mean;
  const auto& b = snapshot.lanes[settings.other].mean;
  std::vector<float> difference(snapshot.pixels());
  for (std::size_t i = 0; i < difference.size(); ++i) {
    difference[i] = luminance({a[0][i] - b[0][i], a[1][i] - b[1][i], a[2][i] - b[2][i]});
  }
  const double end = symmetric_end(difference);
  View view = numbers_view(snapshot, difference, {{-end, end, ColorMapId::coolwarm}, "", ""});
  if (settings.other == lane) {
    view.note = "compared with itself";
  }
  return view;
}

std::vector<std::string> difference_lines(const Snapshot& snapshot, std::size_t lane,
                                          const ViewSettings& settings, std::size_t pixel) {
  if (settings.other >= snapshot.lanes.size()) {
    return {};
  }
  return lines_of(pixel_values(snapshot.lanes[lane], pixel).radiance -
                  pixel_values(snapshot.lanes[settings.other], pixel).radiance);
}

}  // namespace

constexpr ViewRow difference_view{.key = ViewKind::difference,
                                  .id = "difference",
                                  .label = "Difference",
                                  .quantity = "luminance minus the other lane's",
                                  .has_bar = true,
                                  .needs = {.other_lane = true},
                                  .draw = draw_difference,
                                  .lines = difference_lines};

}  // namespace quartet
