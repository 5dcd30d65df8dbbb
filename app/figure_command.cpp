#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/number_check.h"
#include "app/progress.h"
#include "app/run_options.h"
#include "app/run_record.h"
#include "renderer/image/lane_exr.h"
#include "renderer/image/png.h"
#include "renderer/image/staged_files.h"
#include "renderer/version.h"
#include "ui/lab_figure.h"

namespace quartet {
namespace {

struct FigureOptions {
  RunOptions run;
  std::uint32_t frames = 15;
  std::vector<std::string> estimators{"contrast", "kl", "chi2", "hellinger"};
  std::string heat = "linked";
  std::string tone_map = "clamp";
  float exposure = 0.0f;
  std::string out = "out";
};

HeatRange heat_range(const std::string& id) {
  if (id == "linked" || id == "report") {
    return id == "linked" ? HeatRange::linked : HeatRange::report;
  }
  throw UsageError(fmt::format("--heat: unknown scale '{}'; there are: linked, report", id));
}

std::vector<SamplingPolicy> policies_of(const FigureOptions& options) {
  std::vector<SamplingPolicy> policies;
  for (const std::string& id : options.estimators) {
    const EstimatorId key = find_estimator(id).key;
    for (const SamplingPolicy& other : policies) {
      if (other.estimator == key) {
        throw UsageError(fmt::format("--estimators: '{}' is named twice; name each once", id));
      }
    }
    policies.push_back(policy_of(options.run, key));
  }
  return policies;
}

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

void write_lane(StagedFiles& files, const Snapshot& snapshot, std::size_t lane,
                const ViewSettings& view, std::map<std::string, std::string> attributes) {
  const std::string name(estimator(snapshot.lanes[lane].policy.estimator).id);
  ExrImage exr = lane_exr(snapshot, lane);
  exr.attributes = std::move(attributes);
  write_exr(files.stage(name + ".exr"), exr);
  write_png(files.stage(name + ".png"), draw_view(snapshot, lane, ViewKind::image, view).image);
  write_png(files.stage(name + "-heatmap.png"),
            draw_view(snapshot, lane, ViewKind::heatmap, view).image);
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
  const std::vector<SamplingPolicy> policies = policies_of(options);
  ViewSettings view;
  view.exposure = options.exposure;
  view.tone_map = find_tone_map(options.tone_map).key;
  view.heat = heat_range(options.heat);
  const Run run = prepare_run(options.run, policies.size());
  StagedFiles files(options.out);
  Lab lab(sample_source(run.scene, run.settings), run.settings.width, run.settings.height, policies,
          run.lab);
  run_frames(lab, options.frames);
  Snapshot snapshot;
  copy_lanes(lab, snapshot);

  const std::string title = fmt::format("{}, {} frames at {}×{}", run.scene->scene().name,
                                        options.frames, run.settings.width, run.settings.height);
  const std::string footer = fmt::format("quartet {} · {}", version(), program.command_line);
  const Figure images = image_figure(snapshot, view, title, footer);
  write_figure_png(images, files.stage("images.png"));
  write_figure_pdf(images, files.stage("images.pdf"));
  const Figure heatmaps = heat_figure(snapshot, view, title, footer);
  write_figure_png(heatmaps, files.stage("heatmaps.png"));
  write_figure_pdf(heatmaps, files.stage("heatmaps.pdf"));
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    write_lane(files, snapshot, i, view, exr_attributes(program, run, lab.lanes()[i]));
  }
  files.write("panels.csv", csv_record(run, lab));
  files.write("panels.json", json_record(program, run, lab));
  files.commit();
  print_table(lab, options.out);
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
  command->add_option("--estimators", options->estimators, "Which, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  command
      ->add_option("--heat", options->heat,
                   "Heatmap scale: linked (0 to the highest of all) or report (each its own)")
      ->capture_default_str();
  command->add_option("--tone-map", options->tone_map, "clamp, reinhard or filmic")
      ->capture_default_str();
  command->add_option("--exposure", options->exposure, "In stops")
      ->check(number_between(-100.0, 100.0))
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the files, made if need be")->required();
  command->footer(
      "Examples:\n"
      "  quartet figure cornell-checker --out out\n"
      "  quartet figure veach-plates --frames 30 --size 480x270 --estimators contrast,uniform "
      "--heat report --out plates");
  command->callback([options, &program] { run_figure(*options, program); });
}

void run_default_figure(const Program& program) {
  run_figure({}, program);
}

}  // namespace quartet
