#include "ui/paper/lab_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "renderer/adaptive/effort.h"
#include "renderer/base/number_text.h"
#include "ui/paper/cairo_page.h"
#include "ui/paper/figure_layout.h"

namespace quartet {
namespace {

FigurePanel panel(const LaneSnapshot& lane, DisplayImage image) {
  FigurePanel panel;
  panel.image = std::move(image);
  panel.title = estimator(lane.settings.estimator).label;
  std::string numbers = threshold_text(lane.settings);
  if (!lane.history.empty()) {
    const PassRecord& last = lane.history.back();
    numbers += fmt::format(" · mean {:.1f} spp · max {} spp · {:.2f} s",
                           mean_spp(last, lane.taken.size()), last.max_spp, last.seconds);
  }
  panel.lines.push_back(std::move(numbers));
  const auto rejected =
      std::accumulate(lane.rejected.begin(), lane.rejected.end(), std::uint64_t(0));
  if (rejected > 0) {
    panel.lines.push_back(fmt::format("{} samples rejected (negative or not finite)", rejected));
  }
  return panel;
}

Figure grid(std::string title, std::string footer, std::size_t panels) {
  Figure figure;
  figure.title = std::move(title);
  figure.footer = std::move(footer);
  figure.columns = panels == 1 ? 1 : 2;
  return figure;
}

/// The largest that panels of this size can make a figure: few texts leave them large, and long
/// ones take many lines. Only the first of a row has the size, as one decides for all.
std::array<Figure, 2> extreme_figures(int width, int height, std::size_t panels, bool panel_bars) {
  const std::string words = [] {
    std::string text;
    for (int i = 0; i < 400; ++i) {
      text += "wide ";
    }
    return text;
  }();
  const ColorBar bar{{0.0, 1.0, ColorMapId::turbo}, "label", "label"};
  std::array<Figure, 2> figures{grid("", "", panels), grid(words, words, panels)};
  for (std::size_t i = 0; i < panels; ++i) {
    const bool decides = i % std::size_t(figures[0].columns) == 0;
    FigurePanel plain;
    plain.image = decides ? DisplayImage(width, height) : DisplayImage(1, 1);
    FigurePanel wordy = plain;
    wordy.title = words;
    wordy.lines = {words, words};
    plain.bar = wordy.bar = panel_bars ? std::optional(bar) : std::nullopt;
    figures[0].panels.push_back(std::move(plain));
    figures[1].panels.push_back(std::move(wordy));
  }
  for (Figure& figure : figures) {
    figure.shared_bar = panel_bars ? std::nullopt : std::optional(bar);
  }
  return figures;
}

}  // namespace

void check_figure_size(const std::string& option, int width, int height, std::size_t panels,
                       bool panel_bars) {
  // A panel that is too large alone need not be laid out.
  double wide = width;
  double high = height;
  if (width <= max_cairo_side && height <= max_cairo_side) {
    for (const Figure& figure : extreme_figures(width, height, panels, panel_bars)) {
      const FigureLayout layout = lay_out(figure);
      wide = std::max(wide, layout.width);
      high = std::max(high, layout.height);
    }
  }
  if (wide > max_cairo_side || high > max_cairo_side) {
    throw std::invalid_argument(fmt::format(
        "{}: a figure of {} panels of {}x{} has up to {:.0f}x{:.0f} pixels; at most {}x{} would be "
        "right",
        option, panels, width, height, wide, high, max_cairo_side, max_cairo_side));
  }
}

std::string threshold_text(const LaneSettings& settings) {
  const int channels = estimator(settings.estimator).channels;
  if (channels == 0) {
    return "no threshold";
  }
  std::string text = channels == 1 ? "threshold " : "thresholds ";
  for (int c = 0; c < channels; ++c) {
    text += (c > 0 ? ", " : "") + format_number(settings.thresholds[std::size_t(c)]);
  }
  return text;
}

Figure image_figure(const Snapshot& snapshot, const ViewSettings& view, std::string title,
                    std::string footer) {
  Figure figure = grid(std::move(title), std::move(footer), snapshot.lanes.size());
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    figure.panels.push_back(
        panel(snapshot.lanes[i], draw_view(snapshot, i, ViewKind::image, view).image));
  }
  return figure;
}

Figure heat_figure(const Snapshot& snapshot, const ViewSettings& view, std::string title,
                   std::string footer) {
  Figure figure = grid(std::move(title), std::move(footer), snapshot.lanes.size());
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    View heat = draw_view(snapshot, i, ViewKind::heatmap, view);
    figure.panels.push_back(panel(snapshot.lanes[i], std::move(heat.image)));
    if (view.heat == HeatRange::report) {
      figure.panels.back().bar = heat.bar;
    } else if (!figure.shared_bar || figure.shared_bar->cap_label.empty()) {
      figure.shared_bar = heat.bar;
    }
  }
  return figure;
}

}  // namespace quartet
