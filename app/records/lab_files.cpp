#include "app/records/lab_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "renderer/base/cancel.h"
#include "renderer/base/version.h"
#include "renderer/files/png.h"
#include "renderer/view/lane_exr.h"
#include "ui/paper/lab_figure.h"

namespace quartet {
namespace {

/// "15", or "8 to 15" where lanes ended at different passes.
std::string passes_text(const Snapshot& snapshot) {
  const auto passes = [](const LaneSnapshot& lane) {
    return lane.history.empty() ? 0 : lane.history.back().pass;
  };
  const std::uint32_t first = passes(*std::ranges::min_element(snapshot.lanes, {}, passes));
  const std::uint32_t last = passes(*std::ranges::max_element(snapshot.lanes, {}, passes));
  return first == last ? fmt::format("{}", last) : fmt::format("{} to {}", first, last);
}

/// What the files of each lane are called, without extension.
std::vector<std::string> lane_names(std::span<const LaneSettings> lane_settings) {
  std::vector<std::string> names;
  std::map<std::string, int> named;
  for (const LaneSettings& settings : lane_settings) {
    std::string name(estimator(settings.estimator).id);
    if (const int before = named[name]++; before > 0) {
      name += fmt::format("-{}", before + 1);
    }
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

std::vector<std::string> lab_file_names(std::span<const LaneSettings> lane_settings) {
  std::vector<std::string> names{"images.png",   "images.pdf", "heatmaps.png",
                                 "heatmaps.pdf", "panels.csv", "panels.json"};
  for (const std::string& lane : lane_names(lane_settings)) {
    names.insert(names.end(), {lane + ".exr", lane + ".png", lane + "-heatmap.png"});
  }
  return names;
}

void write_lab_files(StagedFiles& files, const Snapshot& snapshot, const ViewSettings& view,
                     const std::string& command_line, const std::optional<RunCost>& cost,
                     const Reference* reference, const std::stop_token& stop) {
  const std::string title = fmt::format("{}, {} passes at {}×{}", snapshot.scene->scene().name,
                                        passes_text(snapshot), snapshot.width, snapshot.height);
  const std::string footer = fmt::format("quartet {} · {}", version(), command_line);
  const Figure images = image_figure(snapshot, view, title, footer);
  write_figure_png(images, files.stage("images.png"));
  check_cancelled(stop);
  write_figure_pdf(images, files.stage("images.pdf"));
  check_cancelled(stop);
  const Figure heatmaps = heat_figure(snapshot, view, title, footer);
  write_figure_png(heatmaps, files.stage("heatmaps.png"));
  check_cancelled(stop);
  write_figure_pdf(heatmaps, files.stage("heatmaps.pdf"));
  std::vector<LaneSettings> lane_settings;
  std::ranges::transform(snapshot.lanes, std::back_inserter(lane_settings),
                         &LaneSnapshot::settings);
  const std::vector<std::string> names = lane_names(lane_settings);
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    check_cancelled(stop);
    const std::string& name = names[i];
    ExrImage exr = lane_exr(snapshot, i);
    exr.attributes = exr_attributes(command_line, snapshot, i, files.run());
    write_exr(files.stage(name + ".exr"), exr);
    check_cancelled(stop);
    write_png(files.stage(name + ".png"), draw_view(snapshot, i, ViewKind::image, view).image);
    write_png(files.stage(name + "-heatmap.png"),
              draw_view(snapshot, i, ViewKind::heatmap, view).image);
  }
  files.write("panels.csv", csv_record(snapshot));
  files.write("panels.json", json_record(command_line, snapshot, cost, reference, files.run()));
}

}  // namespace quartet
