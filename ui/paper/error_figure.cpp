#include "ui/paper/error_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "renderer/base/interval.h"
#include "renderer/base/number_text.h"
#include "renderer/measure/left_out.h"

namespace quartet {
namespace {

/// The value that a share of all numbers is at or below.
float quantile(const ScalarImage& image, double share) {
  const std::size_t last = image.size() - 1;
  const auto index = std::size_t(share * double(last) + 0.5);
  return largest_but({image.pixels().begin(), image.pixels().end()}, last - index);
}

/// Where errors span decades, a linear scale would show a few fireflies in the dark.
ColorScale scale_of(const ScalarImage& map, float highest) {
  constexpr float decades = 1e4f;
  constexpr float wide = 30.0f;
  ColorScale scale;
  scale.color_map = ColorMapId::viridis;
  scale.max = highest > 0.0f ? double(highest) : 1.0;
  if (highest > wide * quantile(map, 0.5)) {
    scale.spacing = Spacing::logarithmic;
    scale.min = scale.max / decades;
  }
  return scale;
}

}  // namespace

Figure error_figure(const RadianceImage& test, const RadianceImage& reference, const Metric& metric,
                    std::string title, std::string footer) {
  const ScalarImage map = map_over_finite(metric, test, reference);
  const float highest = quantile(map, 0.999);
  const ColorScale scale = scale_of(map, highest);
  FigurePanel panel;
  panel.image = DisplayImage(map.width(), map.height());
  apply(map.pixels(), scale, panel.image.pixels());
  const LeftOut left_out = left_out_of(test, reference);
  for (std::size_t i = 0; i < left_out.is_left_out.size(); ++i) {
    if (left_out.is_left_out[i] != 0) {
      constexpr std::uint8_t gray = 128;
      panel.image.pixels()[i] = {gray, gray, gray, 255};
    }
  }
  panel.title = fmt::format("{} {}", metric.label,
                            format_number(compute_over_finite(metric, test, reference)));
  if (!metric.unit.empty()) {
    panel.title += fmt::format(" {}", metric.unit);
  }
  if (left_out.either > 0) {
    panel.lines.push_back(
        fmt::format("{} pixels are not finite, and left out (gray)", left_out.either));
  }
  const auto above = std::ranges::count_if(map.pixels(), [&](float v) { return v > highest; });
  if (above > 0) {
    panel.lines.push_back(fmt::format("{} pixels above the scale, up to {}", above,
                                      format_number(*std::ranges::max_element(map.pixels()))));
  }
  panel.bar = ColorBar{scale, std::string(metric.map_quantity), ""};
  Figure figure;
  figure.title = std::move(title);
  figure.footer = std::move(footer);
  figure.columns = 1;
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace quartet
