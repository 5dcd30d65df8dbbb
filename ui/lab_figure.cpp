#include "ui/lab_figure.h"

#include <fmt/format.h>

#include <numeric>

#include "renderer/image/ticks.h"

namespace quartet {
namespace {

FigurePanel panel(const LaneSnapshot& lane, DisplayImage image) {
  const double pixels = double(lane.taken.size());
  FigurePanel panel;
  panel.image = std::move(image);
  panel.title = estimator(lane.policy.estimator).label;
  std::string numbers = threshold_text(lane.policy);
  if (!lane.history.empty()) {
    const FrameRecord& last = lane.history.back();
    numbers += fmt::format(" · mean {:.1f} spp · max {} spp · {:.2f} s",
                           double(last.samples) / pixels, last.max_spp, last.seconds);
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

}  // namespace

std::string threshold_text(const SamplingPolicy& policy) {
  const int channels = estimator(policy.estimator).channels;
  if (channels == 0) {
    return "no threshold";
  }
  std::string text = channels == 1 ? "threshold " : "thresholds ";
  for (int c = 0; c < channels; ++c) {
    text += (c > 0 ? ", " : "") + format_number(policy.thresholds[std::size_t(c)]);
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
