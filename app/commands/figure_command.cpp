#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/lab_run.h"
#include "app/options/lane_option.h"
#include "app/options/output_check.h"
#include "app/options/reference_option.h"
#include "app/options/run_options.h"
#include "app/options/stop_options.h"
#include "app/options/view_options.h"
#include "app/records/lab_files.h"
#include "app/records/rejected_report.h"
#include "app/records/stop_report.h"
#include "renderer/adaptive/effort.h"
#include "renderer/files/staged_files.h"
#include "renderer/measure/energy.h"
#include "renderer/view/lane_exr.h"
#include "ui/paper/lab_figure.h"

namespace quartet {
namespace {

struct FigureOptions {
  RunOptions run;
  StopOptions stop;
  ReferenceChoice reference;
  LaneOptions lanes;
  ViewOptions view;
  std::string out;
};

void print_table(const Snapshot& snapshot, const std::filesystem::path& out) {
  const Metric& row = metric(default_metric);
  fmt::print("{:<22} {:>7} {:>9} {:>9} {:>9} {:>9}{}\n", "estimator", "passes", "mean spp",
             "max spp", "seconds", "not done",
             snapshot.reference ? fmt::format(" {:>9} {:>17}", "energy", row.label) : "");
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    const LaneSnapshot& lane = snapshot.lanes[i];
    const PassRecord& last = lane.history.back();
    const double pixels = double(snapshot.pixels());
    std::string error;
    if (snapshot.reference) {
      const RadianceImage image = radiance_image(snapshot, i);
      error = fmt::format(" {:>9} {:>17.3g}", energy_text(energy_error(image, *snapshot.reference)),
                          row.compute(image, *snapshot.reference));
    }
    // Labels are UTF-8: fmt pads by what is seen.
    fmt::print("{:<22} {:>7} {:>9.2f} {:>9} {:>9.2f} {:>7.1f} %{}\n",
               estimator(lane.settings.estimator).label, last.pass,
               mean_spp(last, snapshot.pixels()), last.max_spp, last.seconds,
               100.0 * double(last.not_done) / pixels, error);
  }
  fmt::print("images.png, images.pdf, heatmaps.png, heatmaps.pdf and the panels are in {}\n",
             out.string());
}

/// Whether what will be drawn can be written, before it is rendered.
void check_sizes(const RenderSettings& settings, std::size_t lanes, const ViewSettings& view) {
  check_figure_size("--size", settings.width, settings.height, lanes,
                    view.heat == HeatRange::report);
  check_picture_size("--size", settings.width, settings.height, "panel.exr", lane_exr_channels);
}

void run_figure(const FigureOptions& options, const Program& program) {
  const StopConditions stop = stop_conditions(options.stop, !options.reference.empty());
  const std::vector<LaneSettings> lane_settings =
      settings_of_lanes(options.lanes, options.run.lane_settings, stop);
  const ViewSettings view = view_settings(options.view);
  Run run = prepare_run(options.run, lane_settings.size());
  check_rays(stop, run.scene->scene());
  check_sizes(run.settings, lane_settings.size(), view);
  const auto reference = reference_at(options.reference, run);
  run.lab.reference = truth_for(lane_settings, reference);
  StagedFiles files(options.out, lab_file_names(lane_settings));
  Lab lab(sample_source(run.scene, run.settings), run.settings.width, run.settings.height,
          lane_settings, run.lab);
  Snapshot snapshot = run_to_end(lab, or_passes(stop), image_of(reference));
  snapshot.scene = run.scene;
  snapshot.settings = run.settings;
  files.finish([&] {
    write_lab_files(files, snapshot, view, program.command_line,
                    RunCost{run.lab.threads, &lab.store(), lab.pilot_store()}, reference.get());
  });
  print_table(snapshot, options.out);
  report_rejected(snapshot, options.run);
  tell_if_short(snapshot, stop);
  tell_if_partial(lab.partial(), options.run);
}

}  // namespace

void add_figure_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "figure", "The two figures of the 2021 report: images and heatmaps of several estimators");
  const auto options = std::make_shared<FigureOptions>();
  add_run_options(*command, options->run);
  add_stop_options(*command, options->stop);
  add_reference_option(*command, options->reference);
  add_lane_options(*command, options->lanes);
  add_view_options(*command, options->view);
  add_out_option(*command, options->out);
  command->footer(
      "Each lane stops at the first condition that it meets. With --reference, the panels' .exr "
      "also\n"
      "have the channel SquaredError, and panels.csv and panels.json every metric.\n"
      "Examples:\n"
      "  quartet figure cornell-checker --out out\n"
      "  quartet figure veach-plates --passes 30 --size 480x270 --estimators contrast,uniform "
      "--heat report --out plates\n"
      "  quartet figure cornell-box --spp 24 --reference ref.exr --out box");
  command->callback([options, &program] { run_figure(*options, program); });
}

void run_default_figure(const Program& program, const std::string& scene, const std::string& out) {
  FigureOptions options;
  options.out = out;
  options.run.scene = scene.empty() ? options.run.scene : scene;
  run_figure(options, program);
}

}  // namespace quartet
