#include "renderer/view/lane_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace quartet {
namespace {

constexpr Rgba8 chart_text{200, 205, 212, 255};
constexpr std::array<Rgba8, 3> channel_colors{Rgba8{255, 99, 99}, Rgba8{92, 214, 120},
                                              Rgba8{104, 156, 255}};
constexpr std::array channel_names{"R", "G", "B"};
// Far below this share of the pixels an error is a curiosity; far more decades than this squeeze
// the rest.
constexpr double ignored_share = 0.002;
constexpr int most_decades = 6;

Rgba8 with_alpha(Rgba8 color, double alpha) {
  color.a = std::uint8_t(std::lround(255.0 * alpha));
  return color;
}

ChartText top_right(std::string text) {
  return {{0.985, 0.96}, Align::right, std::move(text), chart_text};
}

double percent(std::uint64_t part, std::size_t pixels) {
  return 100.0 * double(part) / double(pixels);
}

/// The whole powers of ten around [10^low, 10^high], as far as histograms reach.
DecadeRange decades_around(double low, double high) {
  return {std::max(int(std::floor(low)), ErrorHistogram::first_exponent),
          std::min(int(std::ceil(high)), ErrorHistogram::end_exponent)};
}

/// The top of each bin is two points: where it begins and where it ends.
Line outline(const ErrorHistogram& histogram, const Axis& x, std::size_t channel,
             std::size_t pixels) {
  Line line;
  line.label = channel_names[channel];
  line.color = channel_colors[channel];
  for (int bin = 0; bin < ErrorHistogram::bins; ++bin) {
    const double begin = ErrorHistogram::begin_of(bin);
    const double end = ErrorHistogram::begin_of(bin + 1);
    const double middle = std::sqrt(begin * end);
    if (middle > x.min && middle < x.max) {
      const double value = percent(histogram.pixels[std::size_t(bin)], pixels);
      line.points.emplace_back(begin, value);
      line.points.emplace_back(end, value);
    }
  }
  return line;
}

/// What the axis cannot show of the errors; empty if there is nothing to say.
std::string error_note(const LaneSnapshot& lane, std::size_t pixels) {
  std::uint32_t zero = UINT32_MAX;
  std::uint32_t infinite = 0;
  for (const ErrorHistogram& histogram : lane.error_histograms) {
    zero = std::min(zero, histogram.zero);
    infinite = std::max(infinite, histogram.infinite);
  }
  if (infinite > 0) {
    return fmt::format("{:.0f} % too few samples", std::ceil(percent(infinite, pixels)));
  }
  const std::uint32_t minimum = minimum_samples(lane.settings);
  if (minimum > 0 && std::ranges::min(lane.taken) < minimum) {
    return fmt::format("none done below {} spp", minimum);
  }
  return percent(zero, pixels) >= 1.0 ? fmt::format("{:.0f} % are 0", percent(zero, pixels)) : "";
}

}  // namespace

DecadeRange error_decades(const LaneSnapshot& lane, const Thresholds& thresholds) {
  std::array<std::uint64_t, ErrorHistogram::bins> pixels{};
  std::uint64_t total = 0;
  for (const ErrorHistogram& histogram : lane.error_histograms) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      pixels[i] += histogram.pixels[i];
      total += histogram.pixels[i];
    }
  }
  const auto ignored = std::uint64_t(ignored_share * double(total));
  DecadeRange range{ErrorHistogram::end_exponent, ErrorHistogram::first_exponent};
  std::uint64_t so_far = 0;
  for (int i = 0; i < ErrorHistogram::bins; ++i) {
    const std::uint64_t here = pixels[std::size_t(i)];
    so_far += here;
    if (here > 0 && so_far > ignored) {
      range = range.with(decades_around(std::log10(ErrorHistogram::begin_of(i)) + 1e-6,
                                        std::log10(ErrorHistogram::begin_of(i + 1)) - 1e-6));
    }
  }
  range.first = std::max(range.first, range.last - most_decades);
  for (std::size_t c = 0; c < lane.error_histograms.size(); ++c) {
    if (thresholds[c] > 0.0f) {
      constexpr double room = 0.3;
      const double at = std::log10(double(thresholds[c]));
      range = range.with(decades_around(at - room, at + room));
    }
  }
  return range.first < range.last ? range : DecadeRange{-1, 0};
}

Chart sample_chart(const Snapshot& snapshot, std::size_t lane, const ColorScale& scale) {
  const LaneSnapshot& shown = snapshot.lanes[lane];
  const SampleHistogram& histogram = shown.sample_histogram;
  std::uint32_t most = 1;
  for (const LaneSnapshot& each : snapshot.lanes) {
    most = std::max(most, each.history.empty() ? 0 : each.history.back().max_spp);
  }
  Chart chart;
  chart.title = "pixels by samples";
  chart.x = linear_axis(0.0, double(most) + 1.0, "samples", 5);
  const double pixels = double(std::max<std::size_t>(snapshot.pixels(), 10));
  chart.y = decade_axis(0, int(std::ceil(std::log10(pixels))), "pixels");
  // A bar of one pixel is to be seen.
  chart.y.min = 0.5;
  for (std::size_t bin = 0; bin < histogram.pixels.size(); ++bin) {
    if (histogram.pixels[bin] > 0) {
      const double begin = double(bin) * double(histogram.width);
      const double end = begin + double(histogram.width);
      const bool capped = end > double(shown.settings.max_spp);
      const Rgba8 color =
          capped ? cap_color
                 : sample(scale.color_map, scale_position(scale, 0.5 * (begin + end - 1.0)));
      chart.bars.push_back({begin, end, double(histogram.pixels[bin]), color});
    }
  }
  if (!shown.history.empty()) {
    chart.texts.push_back(top_right(fmt::format("max {}", shown.history.back().max_spp)));
  }
  return chart;
}

Chart error_chart(const Snapshot& snapshot, std::size_t lane, const Thresholds& thresholds,
                  Rgba8 accent, std::optional<DecadeRange> decades) {
  const LaneSnapshot& shown = snapshot.lanes[lane];
  const Estimator& row = estimator(shown.settings.estimator);
  const std::size_t pixels = snapshot.pixels();
  Chart chart;
  chart.title = "pixels by error";
  const std::string label = row.unit.empty() ? "error" : fmt::format("error ({})", row.unit);
  if (shown.error_histograms.empty()) {
    chart.x = decade_axis(-3, 0, label);
    chart.y = linear_axis(0.0, 1.0, "% of pixels", 2);
    chart.texts.push_back({{0.5, 0.55},
                           Align::center,
                           row.channels == 0 ? "no error: every pixel alike" : "no pass yet",
                           chart_text});
    return chart;
  }
  const DecadeRange axis = decades ? *decades : error_decades(shown, thresholds);
  chart.x = decade_axis(axis.first, axis.last, label);

  double highest = 0.0;
  for (std::size_t c = 0; c < shown.error_histograms.size(); ++c) {
    const ErrorHistogram& histogram = shown.error_histograms[c];
    const bool alone = shown.error_histograms.size() == 1;
    const Rgba8 color = alone ? accent : channel_colors[c];
    const double threshold = double(thresholds[c]);
    Line line = outline(histogram, chart.x, c, pixels);
    for (const glm::dvec2& point : line.points) {
      highest = std::max(highest, point.y);
    }
    if (alone) {
      for (std::size_t i = 0; i + 1 < line.points.size(); i += 2) {
        const glm::dvec2 begin = line.points[i];
        const glm::dvec2 end = line.points[i + 1];
        const bool above = begin.x * end.x > threshold * threshold;
        chart.bars.push_back({begin.x, end.x, begin.y, with_alpha(color, above ? 1.0 : 0.5)});
      }
    } else {
      chart.lines.push_back(std::move(line));
    }
    chart.shades.push_back(
        {std::max(threshold, chart.x.min), chart.x.max, with_alpha(color, alone ? 0.15 : 0.07)});
    chart.markers.push_back({int(c), threshold, alone ? Rgba8{255, 255, 255, 255} : color,
                             alone ? "" : channel_names[c]});
  }
  chart.y = linear_axis(0.0, 1.15 * highest, "% of pixels", 2);
  chart.texts.push_back(top_right(
      fmt::format("{:.0f} % of pixels are not done", percent(shown.plan.not_done, pixels))));
  if (const std::string note = error_note(shown, pixels); !note.empty()) {
    chart.texts.push_back({{0.015, 0.96}, Align::left, note, chart_text});
  }
  return chart;
}

Chart progress_chart(const Snapshot& snapshot, std::size_t lane, Rgba8 accent) {
  const double pixels = double(std::max<std::size_t>(snapshot.pixels(), 1));
  const std::vector<PassRecord>& history = snapshot.lanes[lane].history;
  double most = 0.0;
  for (const LaneSnapshot& each : snapshot.lanes) {
    most = std::max(most, each.history.empty() ? 0.0 : double(each.history.back().samples));
  }
  Chart chart;
  chart.title = "samples so far";
  chart.x = linear_axis(0.0, double(std::max<std::uint32_t>(snapshot.pass, 1)), "pass", 5);
  chart.y = linear_axis(0.0, 1.05 * std::max(most / pixels, 1.0), "samples per pixel", 3);
  // More points than a chart has columns are not seen.
  constexpr std::size_t most_points = 512;
  const std::size_t step = history.size() / most_points + 1;
  Line line;
  line.color = accent;
  line.points.emplace_back(0.0, 0.0);
  for (std::size_t i = step - 1; i < history.size(); i += step) {
    line.points.emplace_back(history[i].pass, double(history[i].samples) / pixels);
  }
  if (!history.empty() && line.points.back().x != double(history.back().pass)) {
    line.points.emplace_back(history.back().pass, double(history.back().samples) / pixels);
  }
  chart.lines.push_back(std::move(line));
  return chart;
}

}  // namespace quartet
