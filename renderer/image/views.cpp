#include "renderer/image/views.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace quartet {

ColorScale heat_scale(HeatRange range, std::span<const Lane> lanes, const Lane& lane) {
  if (range == HeatRange::report) {
    const auto [low, high] = std::ranges::minmax_element(lane.taken());
    return {double(*low), double(*high), ColorMapId::report};
  }
  std::uint32_t highest = 1;
  for (const Lane& each : lanes) {
    highest = std::max(highest, std::ranges::max(each.taken()));
  }
  return {0.0, double(highest), ColorMapId::turbo};
}

DisplayImage heat_view(const Lane& lane, const ColorScale& scale) {
  Image<std::uint32_t> counts(lane.film().width(), lane.film().height());
  std::ranges::copy(lane.taken(), counts.pixels().begin());
  return heatmap(counts, scale, lane.policy().max_spp);
}

ExrImage lane_exr(const Lane& lane) {
  constexpr std::array channel_names{"R", "G", "B"};
  const Film& film = lane.film();
  ExrImage exr(film.width(), film.height());
  exr.add_radiance(film.image());
  const auto add_counts = [&](const char* name, std::span<const std::uint32_t> counts) {
    exr.add(name, std::vector<std::uint32_t>(counts.begin(), counts.end()));
  };
  add_counts("SampleCount", film.counts());
  add_counts("Rejected", film.rejected());

  const Estimator& row = estimator(lane.policy().estimator);
  for (std::size_t c = 0; c < std::size_t(row.channels) && !lane.error().empty(); ++c) {
    const auto plane = lane.error().subspan(c * film.size(), film.size());
    exr.add(row.channels == 1 ? fmt::format("Error.{}", row.id)
                              : fmt::format("Error.{}.{}", row.id, channel_names[c]),
            std::vector<float>(plane.begin(), plane.end()));
  }
  if (film.statistics().variance) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<float> plane(film.size());
      for (std::size_t i = 0; i < film.size(); ++i) {
        plane[i] = float(film.variance_of_mean(i)[int(c)]);
      }
      exr.add(fmt::format("Variance.{}", channel_names[c]), std::move(plane));
    }
  }
  return exr;
}

}  // namespace quartet
