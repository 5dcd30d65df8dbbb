#include <algorithm>
#include <cmath>

#include "renderer/adaptive/histogram.h"
#include "renderer/view/pixel_values.h"
#include "renderer/view/views/view_parts.h"
#include "renderer/view/views/view_rows.h"

namespace quartet {
namespace {

std::vector<float> largest_channel(const std::vector<float>& planes, std::size_t pixels) {
  std::vector<float> largest(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    largest[i] = std::max({planes[i], planes[pixels + i], planes[2 * pixels + i]});
  }
  return largest;
}

/// The power of ten above all but 1 in 50 of the numbers, which are fireflies; first_exponent if
/// none is above 0.
int decade_above(std::span<const float> numbers) {
  ErrorHistogram histogram;
  fill_histogram(numbers, histogram);
  const std::size_t ignored = numbers.size() / 50;
  std::size_t above = 0;
  int bin = ErrorHistogram::bins;
  while (bin > 0 && above <= ignored) {
    above += histogram.pixels[std::size_t(--bin)];
  }
  return above > ignored
             ? ErrorHistogram::first_exponent + bin / ErrorHistogram::bins_per_decade + 1
             : ErrorHistogram::first_exponent;
}

/// Six powers of ten, up to the one above nearly all variances of all lanes. Powers of ten, because
/// the scale would else drift with every pass.
View draw_variance(const Snapshot& snapshot, std::size_t lane, const ViewSettings&) {
  const std::size_t pixels = snapshot.pixels();
  std::vector<float> shown;
  int last = ErrorHistogram::first_exponent;
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    if (!snapshot.lanes[i].variance.empty()) {
      std::vector<float> largest = largest_channel(snapshot.lanes[i].variance, pixels);
      last = std::max(last, decade_above(largest));
      if (i == lane) {
        shown = std::move(largest);
      }
    }
  }
  const double end = std::pow(10.0, last);
  const bool known = sampler_row(snapshot.settings.sampler).knows_variance;
  return numbers_view(snapshot, shown,
                      {{end * 1e-6, end, ColorMapId::viridis, Spacing::logarithmic},
                       known ? "variance of the mean, largest channel (radiance²)"
                             : "s²/n as if samples were independent, largest channel (radiance²)",
                       ""});
}

std::vector<std::string> variance_lines(const Snapshot& snapshot, std::size_t lane,
                                        const ViewSettings&, std::size_t pixel) {
  return lines_of(*pixel_values(snapshot.lanes[lane], pixel).variance);
}

}  // namespace

constexpr ViewRow variance_view{.key = ViewKind::variance,
                                .id = "variance",
                                .label = "Variance",
                                .quantity = "variance of the mean, as far as the sampler tells it",
                                .has_bar = true,
                                .needs = {.variance = true},
                                .draw = draw_variance,
                                .lines = variance_lines};

}  // namespace quartet
