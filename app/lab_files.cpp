#include "app/lab_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "renderer/image/lane_exr.h"
#include "renderer/image/png.h"
#include "renderer/version.h"
#include "ui/lab_figure.h"

namespace quartet {

namespace {

/// "15", or "8 to 15" where lanes ended at different frames.
std::string frames_text(const Snapshot& snapshot) {
  const auto frames = [](const LaneSnapshot& lane) {
    return lane.history.empty() ? 0 : lane.history.back().frame;
  };
  const std::uint32_t first = frames(*std::ranges::min_element(snapshot.lanes, {}, frames));
  const std::uint32_t last = frames(*std::ranges::max_element(snapshot.lanes, {}, frames));
  return first == last ? fmt::format("{}", last) : fmt::format("{} to {}", first, last);
}

}  // namespace

void write_lab_files(StagedFiles& files, const Snapshot& snapshot, const ViewSettings& view,
                     const std::string& command_line, const std::optional<RunCost>& cost,
                     const Reference* reference) {
  const std::string title = fmt::format("{}, {} frames at {}×{}", snapshot.scene->scene().name,
                                        frames_text(snapshot), snapshot.width, snapshot.height);
  const std::string footer = fmt::format("quartet {} · {}", version(), command_line);
  const Figure images = image_figure(snapshot, view, title, footer);
  write_figure_png(images, files.stage("images.png"));
  write_figure_pdf(images, files.stage("images.pdf"));
  const Figure heatmaps = heat_figure(snapshot, view, title, footer);
  write_figure_png(heatmaps, files.stage("heatmaps.png"));
  write_figure_pdf(heatmaps, files.stage("heatmaps.pdf"));
  std::map<std::string, int> named;
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    std::string name(estimator(snapshot.lanes[i].policy.estimator).id);
    if (const int before = named[name]++; before > 0) {
      name += fmt::format("-{}", before + 1);
    }
    ExrImage exr = lane_exr(snapshot, i);
    exr.attributes = exr_attributes(command_line, snapshot, i, files.run());
    write_exr(files.stage(name + ".exr"), exr);
    write_png(files.stage(name + ".png"), draw_view(snapshot, i, ViewKind::image, view).image);
    write_png(files.stage(name + "-heatmap.png"),
              draw_view(snapshot, i, ViewKind::heatmap, view).image);
  }
  files.write("panels.csv", csv_record(snapshot));
  files.write("panels.json", json_record(command_line, snapshot, cost, reference, files.run()));
}

}  // namespace quartet
