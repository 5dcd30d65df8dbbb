#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/bias_files.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/lane_option.h"
#include "app/number_check.h"
#include "app/progress.h"
#include "app/rejected_report.h"
#include "app/run_options.h"
#include "renderer/image/exr.h"
#include "renderer/measure/interval.h"

namespace quartet {
namespace {

struct BiasOptions {
  RunOptions run;
  LaneOptions lanes;
  std::uint32_t frames = 15;
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
               estimator(runs.policy.estimator).id, sample_use(runs.policy.use).id,
               mean_of(runs.mean_spp), mean_of(runs.seconds), energy_text(report, runs),
               mean_p(runs.energy, 0.0));
  }
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
    fmt::print(
        "{}: mode unbiased takes {:.2f} × the time of reuse, and {:.2f} × for the same noise\n",
        estimator(all[i].policy.estimator).id,
        mean_of(all[i + 1].seconds) / mean_of(all[i].seconds),
        price_of_unbiasedness(all[i], all[i + 1]));
  }
}

void run_bias(const BiasOptions& options, const Program& program) {
  const std::vector<SamplingPolicy> policies = policies_of(options.lanes, options.run);
  for (const SamplingPolicy& policy : policies) {
    if (const Estimator& row = estimator(policy.estimator); row.needs_reference) {
      throw UsageError(fmt::format(
          "'{}' compares with a reference, and bias is measured without one, against uniform "
          "sampling; choose another estimator",
          row.id));
    }
  }
  check_seeds(options.run, options.seeds);
  const Run run = prepare_run(options.run, 2 * policies.size());
  // R, G and B, and two for each policy and mode.
  check_exr_size(run.settings.width, run.settings.height, 3 + 4 * policies.size());
  StagedFiles files(options.out);
  std::vector<BiasRuns> all;
  {
    const Interrupt interrupt;
    Progress progress("measuring bias");
    all = measure_bias(
        run.scene, run.settings, policies, options.frames, options.seeds, run.lab,
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
  const BiasReport report{run, all, options.frames, options.confidence, program.command_line};
  files.finish([&] { write_bias_files(files, report); });
  print_table(report);
  const auto most =
      std::ranges::max_element(all, {}, [](const BiasRuns& runs) { return runs.rejected.count; });
  report_rejected(most->rejected, options.run, run.scene, run.settings);
}

}  // namespace

void add_bias_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "bias", "How far off adaptive pictures are on average, and what it costs to be right");
  const auto options = std::make_shared<BiasOptions>();
  add_run_options(*command, options->run);
  add_lane_options(*command, options->lanes);
  command->add_option("--frames", options->frames, "Rounds of sampling of each run")
      ->check(CLI::Range(1u, 1'000'000u))
      ->capture_default_str();
  add_seeds_option(*command, options->seeds, 2);
  command
      ->add_option("--confidence", options->confidence, "Of all intervals together, such as 0.99")
      ->check(number_between(0.5, 0.999999))
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the files, made if need be")->required();
  command->footer(
      "Writes bias.png, bias.pdf, bias.exr and bias.csv. Each policy runs in both modes, reuse and "
      "unbiased.\n"
      "Examples:\n"
      "  quartet bias cornell-checker --size 240x135 --seeds 16 --out bias\n"
      "  quartet bias failures/rare-light --policy batch --estimators contrast,kl --out bias");
  command->callback([options, &program] { run_bias(*options, program); });
}

}  // namespace quartet
