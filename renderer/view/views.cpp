#include "renderer/view/views.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/adaptive/pixel_state.h"
#include "renderer/base/table.h"
#include "renderer/measure/metrics.h"

namespace quartet {
namespace {

View blank(const Snapshot& snapshot, std::string note) {
  View view;
  view.image = DisplayImage(snapshot.width, snapshot.height, kNotANumberColor);
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

View image_view(const Snapshot& snapshot, std::size_t lane, const ViewSettings& settings) {
  View view;
  view.image = to_display(radiance_image(snapshot, lane), settings.exposure, settings.tone_map);
  return view;
}

View heat_view(const Snapshot& snapshot, std::size_t lane, const ViewSettings& settings) {
  const LaneSnapshot& shown = snapshot.lanes[lane];
  const std::uint32_t cap = shown.policy.max_spp;
  View view;
  view.bar = {heat_scale(snapshot, lane, settings.heat), "", ""};
  if (!shown.history.empty() && shown.history.back().max_spp >= cap) {
    view.bar->cap_label = fmt::format("the maximum of {} spp", cap);
  }
  view.image = DisplayImage(snapshot.width, snapshot.height);
  heatmap(shown.taken, view.bar->scale, cap, view.image.pixels());
  return view;
}

/// Linear from 0 to twice the threshold, so that what decides lies in the middle of the scale; how
/// far beyond it an error is, its histogram shows.
View error_view(const Snapshot& snapshot, std::size_t lane, const ViewSettings&) {
  const std::vector<float> scaled = largest_scaled_errors(snapshot.lanes[lane]);
  if (scaled.empty()) {
    return blank(snapshot, estimator(snapshot.lanes[lane].policy.estimator).channels == 0
                               ? "uniform sampling estimates no error"
                               : "no frame yet");
  }
  return numbers_view(snapshot, scaled, {{0.0, 2.0, ColorMapId::turbo}, "", ""});
}

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
/// the scale would else drift with every frame.
View variance_view(const Snapshot& snapshot, std::size_t lane, const ViewSettings&) {
  const std::size_t pixels = snapshot.pixels();
  if (snapshot.lanes[lane].variance.empty()) {
    return blank(snapshot, "the variance was not asked for");
  }
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
  return numbers_view(snapshot, shown,
                      {{end * 1e-6, end, ColorMapId::viridis, Spacing::logarithmic}, "", ""});
}

View stop_view(const Snapshot& snapshot, std::size_t lane, const ViewSettings&) {
  const LaneSnapshot& shown = snapshot.lanes[lane];
  const std::uint32_t minimum = minimum_samples(shown.policy);
  std::string refining(pixel_state_label(PixelState::refining));
  if (estimator(shown.policy.estimator).channels > 0) {
    refining += ": error above its threshold";
    refining += minimum > 0 ? fmt::format(" or below {} spp", minimum) : "";
  }
  View view;
  // In the order of the states.
  view.legend = {{{46, 88, 130}, std::string(pixel_state_label(PixelState::done))},
                 {{232, 119, 46}, std::move(refining)},
                 {kCapColor, fmt::format("{} of {} spp", pixel_state_label(PixelState::at_maximum),
                                         shown.policy.max_spp)}};
  view.image = DisplayImage(snapshot.width, snapshot.height);
  const std::vector<PixelState> states = pixel_states(shown);
  for (std::size_t i = 0; i < states.size(); ++i) {
    ColorMeaning& meaning = view.legend[std::size_t(states[i])];
    ++meaning.pixels;
    view.image.pixels()[i] = meaning.color;
  }
  return view;
}

View rejected_view(const Snapshot& snapshot, std::size_t lane, const ViewSettings&) {
  const std::vector<std::uint32_t>& rejected = snapshot.lanes[lane].rejected;
  std::uint32_t highest = 1;
  for (const LaneSnapshot& each : snapshot.lanes) {
    highest = std::max(highest, each.rejected.empty() ? 0 : std::ranges::max(each.rejected));
  }
  std::vector<float> counts(rejected.begin(), rejected.end());
  counts.resize(snapshot.pixels(), 0.0f);
  View view = numbers_view(snapshot, counts, {{0.0, double(highest), ColorMapId::viridis}, "", ""});
  if (rejected.empty()) {
    view.note = "no sample was rejected";
  }
  return view;
}

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
  const auto place = sizes.begin() + std::ptrdiff_t(sizes.size() - 1 - sizes.size() / 20);
  std::ranges::nth_element(sizes, place);
  const double size = double(*place);
  const double power = std::pow(10.0, std::floor(std::log10(size)));
  const double digit = size / power;
  return power * (digit <= 1.0 ? 1.0 : digit <= 2.0 ? 2.0 : digit <= 5.0 ? 5.0 : 10.0);
}

View difference_view(const Snapshot& snapshot, std::size_t lane, const ViewSettings& settings) {
  if (settings.other >= snapshot.lanes.size()) {
    return blank(snapshot, "there is no such lane to compare with");
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

constexpr const char* no_reference = "there is no reference for this view";

/// On a scale that depends on nothing, so that a colour means the same in every lane, at every
/// frame: from errors that are not seen to as large as the picture itself.
View true_error_view(const Snapshot& snapshot, std::size_t lane, const ViewSettings&) {
  if (!snapshot.reference) {
    return blank(snapshot, no_reference);
  }
  const ScalarImage map =
      metric(MetricId::relmse).map(radiance_image(snapshot, lane), *snapshot.reference);
  return numbers_view(snapshot, map.pixels(),
                      {{1e-6, 1.0, ColorMapId::viridis, Spacing::logarithmic}, "", ""});
}

View reference_view(const Snapshot& snapshot, std::size_t, const ViewSettings& settings) {
  if (!snapshot.reference) {
    return blank(snapshot, no_reference);
  }
  View view;
  view.image = to_display(*snapshot.reference, settings.exposure, settings.tone_map);
  return view;
}

constexpr std::array view_table{
    ViewRow{ViewKind::image, "image", "Image", "", false, image_view},
    ViewRow{ViewKind::heatmap, "heatmap", "Samples", "samples per pixel", true, heat_view},
    ViewRow{ViewKind::error, "error", "Error", "error / threshold", true, error_view},
    ViewRow{ViewKind::variance, "variance", "Variance of mean",
            "variance of the mean, largest channel (radiance²)", true, variance_view},
    ViewRow{ViewKind::stop_state, "stop", "Stop state", "", false, stop_view},
    ViewRow{ViewKind::rejected, "rejected", "Rejected", "rejected samples per pixel", true,
            rejected_view},
    ViewRow{ViewKind::difference, "difference", "Difference", "luminance minus the other lane's",
            true, difference_view},
    ViewRow{ViewKind::true_error, "true-error", "True error",
            "relative squared error against the reference, (x − r)² / (r² + 0.01)", true,
            true_error_view},
    ViewRow{ViewKind::reference, "reference", "Reference", "", false, reference_view},
};

}  // namespace

std::span<const ViewRow> views() {
  return view_table;
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
  View view = row.draw(snapshot, lane, settings);
  if (view.bar) {
    view.bar->label = row.quantity;
  }
  return view;
}

ColorScale heat_scale(const Snapshot& snapshot, std::size_t lane, HeatRange range) {
  if (range == HeatRange::report) {
    const auto [low, high] = std::ranges::minmax_element(snapshot.lanes[lane].taken);
    return {double(*low), double(*high), ColorMapId::report};
  }
  std::uint32_t highest = 1;
  for (const LaneSnapshot& each : snapshot.lanes) {
    highest = std::max(highest, each.history.empty() ? 0 : each.history.back().max_spp);
  }
  return {0.0, double(highest), ColorMapId::turbo};
}

}  // namespace quartet
