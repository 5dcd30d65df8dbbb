#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/lab_files.h"
#include "app/lane_option.h"
#include "app/number_check.h"
#include "app/progress.h"
#include "app/rejected_report.h"
#include "app/run_options.h"
#include "renderer/image/staged_files.h"

namespace quartet {
namespace {

struct FigureOptions {
  RunOptions run;
  std::uint32_t frames = 15;
  LaneOptions lanes;
  ViewOptions view;
  std::string out = "out";
};

void run_frames(Lab& lab, std::uint32_t frames) {
  const Interrupt interrupt;
  Progress progress("rendering");
  while (lab.frame() < frames) {
    if (!lab.run_frame(interrupt.token()) || interrupt.token().stop_requested()) {
      throw Interrupted();
    }
    progress.update(double(lab.frame()) / double(frames),
                    fmt::format("frame {} of {}", lab.frame(), frames));
  }
}

void print_table(const Lab& lab, const std::filesystem::path& out) {
  fmt::print("{:<22} {:>9} {:>9} {:>9} {:>9}\n", "estimator", "mean spp", "max spp", "seconds",
             "refining");
  for (const Lane& lane : lab.lanes()) {
    const FrameRecord& last = lane.history().back();
    const double pixels = double(lane.film().size());
    // Labels are UTF-8: fmt pads by what is seen.
    fmt::print("{:<22} {:>9.2f} {:>9} {:>9.2f} {:>7.1f} %\n",
               estimator(lane.policy().estimator).label, double(last.samples) / pixels,
               last.max_spp, last.seconds, 100.0 * double(last.refined) / pixels);
  }
  fmt::print("images.png, images.pdf, heatmaps.png, heatmaps.pdf and the panels are in {}\n",
             out.string());
}

void run_figure(const FigureOptions& options, const Program& program) {
  const std::vector<SamplingPolicy> policies = policies_of(options.lanes, options.run);
  const ViewSettings view = view_settings(options.view);
  const Run run = prepare_run(options.run, policies.size());
  StagedFiles files(options.out);
  Lab lab(sample_source(run.scene, run.settings), run.settings.width, run.settings.height, policies,
          run.lab);
  run_frames(lab, options.frames);
  Snapshot snapshot;
  copy_lanes(lab, snapshot);
  snapshot.scene = run.scene;
  snapshot.settings = run.settings;
  write_lab_files(files, snapshot, view, program.command_line,
                  RunCost{run.lab.threads, &lab.store()});
  files.commit();
  print_table(lab, options.out);
  report_rejected(snapshot, options.run);
}

}  // namespace

void add_figure_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "figure", "The two figures of the 2021 report: images and heatmaps of several estimators");
  const auto options = std::make_shared<FigureOptions>();
  add_run_options(*command, options->run);
  command->add_option("--frames", options->frames, "Rounds of sampling")
      ->check(CLI::Range(1u, 10'000'000u))
      ->capture_default_str();
  add_lane_options(*command, options->lanes);
  add_view_options(*command, options->view);
  command->add_option("--out", options->out, "Folder for the files, made if need be")->required();
  command->footer(
      "Examples:\n"
      "  quartet figure cornell-checker --out out\n"
      "  quartet figure veach-plates --frames 30 --size 480x270 --estimators contrast,uniform "
      "--heat report --out plates");
  command->callback([options, &program] { run_figure(*options, program); });
}

void run_default_figure(const Program& program, const std::string& scene) {
  FigureOptions options;
  options.run.scene = scene.empty() ? options.run.scene : scene;
  run_figure(options, program);
}

}  // namespace quartet
