#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/number_check.h"
#include "app/progress.h"
#include "app/rejected_report.h"
#include "app/run_options.h"
#include "app/run_record.h"
#include "renderer/image/lane_exr.h"
#include "renderer/image/png.h"
#include "renderer/image/staged_files.h"
#include "renderer/image/views.h"

namespace quartet {
namespace {

struct RenderOptions {
  RunOptions run;
  std::string estimator = "uniform";
  std::vector<float> thresholds;
  std::optional<std::uint32_t> frames;
  std::optional<double> spp;
  std::optional<double> seconds;
  std::string output;
};

/// The first condition that holds ends the rendering; without any, the report's 15 frames.
struct StopConditions {
  std::optional<std::uint32_t> frames;
  std::optional<double> spp;
  std::optional<double> seconds;

  /// How much of the way to the nearest end is done; 1 or more at the end.
  double progress(const Lane& lane) const {
    if (lane.history().empty()) {
      return 0.0;
    }
    const FrameRecord& last = lane.history().back();
    double done = 0.0;
    if (frames) {
      done = std::max(done, double(last.frame) / double(*frames));
    }
    if (spp) {
      done = std::max(done, double(last.samples) / double(lane.film().size()) / *spp);
    }
    if (seconds) {
      done = std::max(done, last.seconds / *seconds);
    }
    // With every pixel at its maximum, no condition would ever be met.
    return lane.plan().total == 0 ? 1.0 : done;
  }
};

SamplingPolicy render_policy(const RenderOptions& options) {
  const Estimator& row = find_estimator(options.estimator);
  SamplingPolicy policy = policy_of(options.run, row.key);
  const std::vector<float>& given = options.thresholds;
  if (given.empty()) {
    return policy;
  }
  if (row.channels == 0) {
    throw UsageError(fmt::format("--threshold: estimator '{}' has none", row.id));
  }
  if (given.size() != 1 && given.size() != std::size_t(row.channels)) {
    throw UsageError(fmt::format("--threshold: {} numbers given; estimator '{}' takes {}",
                                 given.size(), row.id, row.channels == 1 ? "1" : "1 or 3"));
  }
  for (std::size_t c = 0; c < std::size_t(row.channels); ++c) {
    policy.thresholds[c] = given[std::min(c, given.size() - 1)];
  }
  return policy;
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
  files.commit();
}

void run_render(const RenderOptions& options, const Program& program) {
  const std::filesystem::path output = options.output;
  if (output.extension() != ".exr" && output.extension() != ".png") {
    throw UsageError(fmt::format("-o: '{}' is neither .exr nor .png", options.output));
  }
  const SamplingPolicy policy = render_policy(options);
  StopConditions stop{options.frames, options.spp, options.seconds};
  if (!stop.frames && !stop.spp && !stop.seconds) {
    stop.frames = 15;
  }
  const Run run = prepare_run(options.run, 1);
  StagedFiles files(output.parent_path());
  Lab lab(sample_source(run.scene, run.settings), run.settings.width, run.settings.height,
          std::span(&policy, 1), run.lab);
  const Lane& lane = lab.lanes().front();
  {
    const Interrupt interrupt;
    Progress progress("rendering");
    while (stop.progress(lane) < 1.0) {
      if (!lab.run_frame(interrupt.token()) || interrupt.token().stop_requested()) {
        throw Interrupted();
      }
      progress.update(stop.progress(lane), fmt::format("frame {}, {:.1f} spp", lane.frame(),
                                                       double(lane.history().back().samples) /
                                                           double(lane.film().size())));
    }
  }
  Snapshot snapshot;
  copy_lanes(lab, snapshot);
  snapshot.scene = run.scene;
  snapshot.settings = run.settings;
  write_output(output, program, snapshot, files);
  const FrameRecord& last = lane.history().back();
  fmt::print("{}: {} frames, mean {:.2f} spp, max {} spp, {:.2f} s\n", output.string(), last.frame,
             double(last.samples) / double(lane.film().size()), last.max_spp, last.seconds);
  report_rejected(snapshot, options.run);
}

}  // namespace

void add_render_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand("render", "One picture with one estimator");
  const auto options = std::make_shared<RenderOptions>();
  add_run_options(*command, options->run);
  command->add_option("--estimator", options->estimator, "Which; see quartet list")
      ->capture_default_str();
  command
      ->add_option("--threshold", options->thresholds,
                   "One number, or three for contrast: R,G,B; the estimator's default if not given")
      ->delimiter(',')
      ->check(number_above_zero());
  command->add_option("--frames", options->frames, "Stop after so many rounds of sampling")
      ->check(CLI::Range(1u, 1u << 31));
  command->add_option("--spp", options->spp, "Stop at this mean of samples per pixel")
      ->check(number_above_zero());
  command->add_option("--seconds", options->seconds, "Stop after so much time spent on the lane")
      ->check(number_above_zero());
  command->add_option("-o,--output", options->output, "A .exr with all channels, or a .png")
      ->required();
  command->footer(
      "Stops at the first condition met; 15 frames if none is given.\n"
      "Examples:\n"
      "  quartet render cornell-checker --estimator kl --threshold 0.005 --frames 15 -o kl.exr\n"
      "  quartet render cornell-box --spp 256 --size 512x512 -o box.png");
  command->callback([options, &program] { run_render(*options, program); });
}

}  // namespace quartet
