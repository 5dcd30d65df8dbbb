#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/commands/commands.h"
#include "app/options/lane_option.h"
#include "app/options/number_option.h"
#include "app/options/output_check.h"
#include "app/options/run_options.h"
#include "app/options/usage_error.h"
#include "app/records/bias_files.h"
#include "app/records/rejected_report.h"
#include "app/records/stop_report.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "renderer/base/interval.h"
#include "ui/paper/lab_figure.h"

namespace quartet {
namespace {

struct BiasOptions {
  RunOptions run;
  LaneOptions lanes;
  std::uint32_t passes = 15;
  std::uint32_t seeds = 16;
  double confidence = 0.99;
  std::string out;
};

void print_table(const BiasReport& report) {
  const std::vector<BiasRuns>& all = report.runs;
  fmt::print("{:<16} {:<9} {:>9} {:>9}  {:<26} {:>9}\n", "estimator", "mode", "mean spp", "seconds",
             fmt::format("energy ({:g} % interval)", 100.0 * report.confidence), "p");
  for (const BiasRuns& runs : all) {
    fmt::print("{:<16} {:<9} {:>9.2f} {:>9.3f}  {:<26} {:>9.2g}\n",
               estimator(runs.settings.estimator).id, sample_mode(runs.settings.mode).id,
               mean_of(runs.mean_spp), mean_of(runs.seconds), energy_text(report, runs),
               mean_p(energies_less_uniform(runs), 0.0));
  }
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
    fmt::print(
        "{}: mode unbiased takes {:.2f} × the time of reuse, and {:.2f} × for the same noise\n",
        estimator(all[i].settings.estimator).id,
        mean_of(all[i + 1].seconds) / mean_of(all[i].seconds),
        price_of_unbiasedness(all[i], all[i + 1]));
  }
}

/// Both modes are run, so that choosing one would do nothing.
void check_modes(const BiasOptions& options) {
  for (const std::string& lane : options.lanes.lanes) {
    if (lane.find("mode=") != std::string::npos) {
      throw UsageError(
          fmt::format("--lane: '{}': mode has no effect: each lane runs in both modes", lane));
    }
  }
}

/// Whether what will be drawn can be written, before it is measured.
void check_bias_size(const RenderSettings& settings, std::size_t runs) {
  const std::size_t channels = 3 + 2 * runs;  // R, G and B, and two for each run
  check_picture_size("--size", settings.width, settings.height, "bias.exr", channels);
  check_figure_size("--size", settings.width, settings.height, runs, false);
}

void run_bias(const BiasOptions& options, const Program& program) {
  const std::vector<LaneSettings> lane_settings =
      settings_of_lanes(options.lanes, options.run.lane_settings, {.passes = options.passes});
  for (const LaneSettings& settings : lane_settings) {
    if (const Estimator& row = estimator(settings.estimator); row.needs_reference) {
      throw UsageError(fmt::format(
          "'{}' compares with a reference, and bias is measured without one, against uniform "
          "sampling; choose another estimator",
          row.id));
    }
  }
  check_modes(options);
  check_seeds(options.run, options.seeds);
  const Run run = prepare_run(options.run, 2 * lane_settings.size());
  check_bias_size(run.settings, 2 * lane_settings.size());
  StagedFiles files(options.out, bias_file_names());
  std::vector<BiasRuns> all;
  {
    const Interrupt interrupt;
    Progress progress("measuring bias");
    all = measure_bias(
        run.scene, run.settings, lane_settings, options.passes, options.seeds, run.lab,
        [&](double done) {
          progress.update(
              done, fmt::format("seed {} of {}",
                                std::min(options.seeds, 1 + std::uint32_t(done * options.seeds)),
                                options.seeds));
        },
        interrupt.token());
    if (all.empty()) {
      throw Interrupted();
    }
  }
  const BiasReport report{run, all, options.passes, options.confidence, program.command_line};
  files.finish([&] { write_bias_files(files, report); });
  print_table(report);
  RejectedCount rejected;
  CappedPixels capped;
  for (const BiasRuns& runs : all) {
    keep_most(rejected, runs.rejected);
    keep_most(capped, runs.capped);
  }
  report_rejected(rejected, options.run, run.scene, run.settings);
  tell_if_capped(capped, CappedRun::most_of_many);
  tell_if_partial(all.front().partial, options.run);
}

}  // namespace

void add_bias_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "bias", "How far off adaptive pictures are on average, and what it costs to be right");
  const auto options = std::make_shared<BiasOptions>();
  add_run_options(*command, options->run);
  command->remove_option(command->get_option("--mode"));  // it runs both
  add_lane_options(*command, options->lanes);
  add_number(*command, "--passes,--frames", options->passes, {1, 1'000'000}, "Passes of each run");
  add_seeds_option(*command, options->seeds, 2);
  add_number(*command, "--confidence", options->confidence, confidence_range,
             "Of all intervals together, such as 0.99");
  add_out_option(*command, options->out);
  command->footer(
      "Writes bias.png, bias.pdf, bias.exr and bias.csv. Each lane runs in both modes, reuse and "
      "unbiased.\n"
      "Examples:\n"
      "  quartet bias cornell-checker --size 240x135 --seeds 16 --out bias\n"
      "  quartet bias failures/rare-light --policy batch --estimators contrast,kl --out bias");
  command->callback([options, &program] { run_bias(*options, program); });
}

}  // namespace quartet
