#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/lab_run.h"
#include "app/options/number_option.h"
#include "app/options/output_check.h"
#include "app/options/reference_option.h"
#include "app/options/run_options.h"
#include "app/options/stop_options.h"
#include "app/options/usage_error.h"
#include "app/records/rejected_report.h"
#include "app/records/run_record.h"
#include "app/records/stop_report.h"
#include "renderer/adaptive/effort.h"
#include "renderer/files/png.h"
#include "renderer/files/staged_files.h"
#include "renderer/measure/energy.h"
#include "renderer/view/lane_exr.h"
#include "renderer/view/views.h"

namespace quartet {
namespace {

struct RenderOptions {
  RunOptions run;
  std::string estimator = "uniform";
  std::vector<float> thresholds;
  StopOptions stop;
  ReferenceChoice reference;
  std::string output;
};

LaneSettings chosen_settings(const RenderOptions& options, const StopConditions& stop) {
  const Estimator& row = find_estimator(options.estimator);
  const ChosenLane lane{settings_of(options.run.lane_settings, row.key), {}};
  LaneSettings settings =
      checked_settings(options.run.lane_settings, std::span(&lane, 1), stop).front();
  const std::vector<float>& given = options.thresholds;
  if (given.empty()) {
    return settings;
  }
  if (row.channels == 0) {
    throw UsageError(fmt::format("--threshold: estimator '{}' has none", row.id));
  }
  if (given.size() != 1 && given.size() != std::size_t(row.channels)) {
    throw UsageError(fmt::format("--threshold: {} numbers given; estimator '{}' takes {}",
                                 given.size(), row.id, row.channels == 1 ? "1" : "1 or 3"));
  }
  for (std::size_t c = 0; c < std::size_t(row.channels); ++c) {
    settings.thresholds[c] = given[std::min(c, given.size() - 1)];
  }
  return settings;
}

void write_output(const std::filesystem::path& path, const Program& program,
                  const Snapshot& snapshot, StagedFiles& files) {
  const std::filesystem::path temporary = files.stage(path.filename().string());
  if (path.extension() == ".png") {
    write_png(temporary, draw_view(snapshot, 0, ViewKind::image, {}).image);
  } else {
    ExrImage exr = lane_exr(snapshot, 0);
    exr.attributes = exr_attributes(program.command_line, snapshot, 0);
    write_exr(temporary, exr);
  }
}

/// What can be known of the output before anything is rendered.
void check_render_output(const RenderOptions& options, const RenderSettings& settings) {
  check_picture_size("--size", settings.width, settings.height, options.output, lane_exr_channels);
  std::error_code ignored;
  if (std::filesystem::equivalent(options.output, options.reference.path, ignored)) {
    throw UsageError(fmt::format("-o: '{}' is the reference, which would be lost", options.output));
  }
}

void print_summary(const std::filesystem::path& path, const Snapshot& snapshot,
                   const Reference* reference) {
  const PassRecord& last = snapshot.lanes[0].history.back();
  fmt::print("{}: {} passes, mean {:.2f} spp, max {} spp, {:.2f} s", path.string(), last.pass,
             mean_spp(last, snapshot.pixels()), last.max_spp, last.seconds);
  if (reference != nullptr) {
    const Metric& row = metric(default_metric);
    const RadianceImage image = radiance_image(snapshot, 0);
    fmt::print(", {} {:.4g}, energy {}", row.label, row.compute(image, reference->image),
               energy_text(energy_error(image, reference->image)));
  }
  fmt::print("\n");
}

void run_render(const RenderOptions& options, const Program& program) {
  const std::filesystem::path output = options.output;
  if (output.extension() != ".exr" && output.extension() != ".png") {
    throw UsageError(fmt::format("-o: '{}' is neither .exr nor .png", options.output));
  }
  const StopConditions stop = stop_conditions(options.stop, !options.reference.empty());
  const LaneSettings settings = chosen_settings(options, stop);
  Run run = prepare_run(options.run, 1);
  check_rays(stop, run.scene->scene());
  check_render_output(options, run.settings);
  const auto reference = reference_at(options.reference, run);
  run.lab.reference = truth_for(std::span(&settings, 1), reference);
  StagedFiles files(output.parent_path(), {output.filename().string()});
  Lab lab(sample_source(run.scene, run.settings), run.settings.width, run.settings.height,
          std::span(&settings, 1), run.lab);
  Snapshot snapshot = run_to_end(lab, or_passes(stop), image_of(reference));
  snapshot.scene = run.scene;
  snapshot.settings = run.settings;
  files.finish([&] { write_output(output, program, snapshot, files); });
  print_summary(output, snapshot, reference.get());
  tell_if_short(snapshot, stop);
  tell_if_partial(lab.partial(), options.run);
  report_rejected(snapshot, options.run);
}

}  // namespace

void add_render_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand("render", "One picture with one estimator");
  const auto options = std::make_shared<RenderOptions>();
  add_run_options(*command, options->run);
  command->add_option("--estimator", options->estimator, "Which; see quartet list")
      ->capture_default_str();
  add_numbers(*command, "--threshold", options->thresholds, threshold_limits,
              "One number, or three for contrast: R,G,B; the estimator's default if not given")
      ->expected(1, 3);
  add_stop_options(*command, options->stop);
  add_reference_option(*command, options->reference);
  command->add_option("-o,--output", options->output, "A .exr with all channels, or a .png")
      ->required();
  command->footer(
      "Stops at the first condition met; 15 passes if none is given. With --reference, an .exr\n"
      "also has the channel SquaredError.\n"
      "Examples:\n"
      "  quartet render cornell-checker --estimator kl --threshold 0.005 --passes 15 -o kl.exr\n"
      "  quartet render cornell-box --spp 256 --size 512x512 -o box.png\n"
      "  quartet render cornell-box --error relmse=0.01 --seconds 60 --reference ref.exr -o "
      "box.exr");
  command->callback([options, &program] { run_render(*options, program); });
}

}  // namespace quartet
