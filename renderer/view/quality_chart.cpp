#include "renderer/view/quality_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quartet {
namespace {

constexpr Rgba8 note_color{200, 205, 212, 255};

std::string quality_text(const EstimatorQuality& quality) {
  std::string text = std::isnan(quality.rank_correlation)
                         ? std::string("no rank correlation")
                         : fmt::format("rank correlation {:.2f}", quality.rank_correlation);
  if (!std::isnan(quality.stops.share())) {
    text += fmt::format(", {:.0f} % false stops", 100.0 * quality.stops.share());
  }
  return text;
}

}  // namespace

Chart quality_chart(const EstimatorQuality& quality, std::string title, Rgba8 accent) {
  Chart chart;
  chart.title = std::move(title);
  Line line;
  line.color = accent;
  line.dots = true;
  double x_low = 1.0, x_high = 1.0;  // the threshold is always in sight
  double y_low = INFINITY, y_high = 0.0;
  for (const CalibrationBin& bin : quality.calibration) {
    if (bin.estimated > 0.0 && bin.true_squared_error > 0.0) {
      line.points.emplace_back(bin.estimated, bin.true_squared_error);
      x_low = std::min(x_low, bin.estimated);
      x_high = std::max(x_high, bin.estimated);
      y_low = std::min(y_low, bin.true_squared_error);
      y_high = std::max(y_high, bin.true_squared_error);
    }
  }
  chart.x = log_axis(x_low / 1.2, x_high * 1.2, "error / threshold", 5);
  chart.y = log_axis(line.points.empty() ? 1e-3 : y_low, line.points.empty() ? 1.0 : y_high,
                     "true squared error", 4);
  if (line.points.empty()) {
    chart.texts.push_back({{0.5, 0.55}, Align::center, "no estimate of the error", note_color});
    return chart;
  }
  Rgba8 shade = accent;
  shade.a = 38;
  chart.shades.push_back({1.0, chart.x.max, shade});
  chart.lines.push_back(std::move(line));
  chart.texts.push_back({{0.03, 0.96}, Align::left, quality_text(quality), note_color});
  return chart;
}

}  // namespace quartet
