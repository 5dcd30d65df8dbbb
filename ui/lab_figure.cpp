#include "ui/lab_figure.h"

#include <fmt/format.h>

#include "renderer/image/ticks.h"

namespace quartet {
namespace {

FigurePanel panel(const Lane& lane, DisplayImage image) {
  const Estimator& row = estimator(lane.policy().estimator);
  FigurePanel panel;
  panel.image = std::move(image);
  panel.title = row.label;
  std::string numbers = threshold_text(lane.policy());
  if (!lane.history().empty()) {
    const FrameRecord& last = lane.history().back();
    numbers +=
        fmt::format(" · mean {:.1f} spp · max {} spp · {:.2f} s",
                    double(last.samples) / double(lane.film().size()), last.max_spp, last.seconds);
  }
  panel.lines.push_back(std::move(numbers));
  if (const std::uint64_t rejected = lane.film().total_rejected(); rejected > 0) {
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

std::string cap_label(const Lane& lane) {
  const bool capped =
      !lane.history().empty() && lane.history().back().max_spp >= lane.policy().max_spp;
  return capped ? fmt::format("at the maximum of {} spp", lane.policy().max_spp) : "";
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

Figure image_figure(std::span<const Lane> lanes, const ViewSettings& view, std::string title,
                    std::string footer) {
  Figure figure = grid(std::move(title), std::move(footer), lanes.size());
  for (const Lane& lane : lanes) {
    figure.panels.push_back(
        panel(lane, to_display(lane.film().image(), view.exposure, view.tone_map)));
  }
  return figure;
}

Figure heat_figure(std::span<const Lane> lanes, const ViewSettings& view, std::string title,
                   std::string footer) {
  Figure figure = grid(std::move(title), std::move(footer), lanes.size());
  for (const Lane& lane : lanes) {
    const ColorBar bar{heat_scale(view.heat, lanes, lane), "samples per pixel", cap_label(lane)};
    figure.panels.push_back(panel(lane, heat_view(lane, bar.scale)));
    if (view.heat == HeatRange::report) {
      figure.panels.back().bar = bar;
    } else if (!figure.shared_bar || figure.shared_bar->cap_label.empty()) {
      figure.shared_bar = bar;
    }
  }
  return figure;
}

}  // namespace quartet
