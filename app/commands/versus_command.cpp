#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/commands/commands.h"
#include "app/options/lane_option.h"
#include "app/options/number_option.h"
#include "app/options/optional_file.h"
#include "app/options/reference_option.h"
#include "app/options/run_options.h"
#include "app/options/stop_options.h"
#include "app/options/usage_error.h"
#include "app/records/rejected_report.h"
#include "app/records/stop_report.h"
#include "app/records/versus_files.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"

namespace quartet {
namespace {

struct VersusOptions {
  std::array<std::string, 2> lanes;
  RunOptions run;
  std::optional<double> spp;
  std::optional<double> rays;
  std::optional<double> seconds;
  std::uint32_t seeds = 8;
  double confidence = 0.95;
  std::string metric{quartet::metric(default_metric).id};
  ReferenceChoice reference;
  std::uint32_t reference_spp = 1024;
  std::string csv;
  bool json = false;
};

constexpr std::array compared_metrics{MetricId::relmse_regions, MetricId::relmse,
                                      MetricId::relmse_trimmed, MetricId::mse,
                                      MetricId::smape,          MetricId::flip};

VersusPlan versus_plan(const VersusOptions& options) {
  VersusPlan plan;
  plan.seeds = options.seeds;
  if (options.rays) {
    plan.effort = Effort::rays;
    plan.goal = *options.rays;
  } else if (options.seconds) {
    plan.effort = Effort::seconds;
    plan.goal = *options.seconds;
  } else {
    plan.goal = options.spp.value_or(plan.goal);
  }
  const Metric& chosen = find_metric(options.metric);
  if (chosen.scale == MetricScale::decibels) {
    throw UsageError(
        fmt::format("--metric: errors in {} have no ratio; mse would say the same", chosen.unit));
  }
  plan.metrics = {chosen.key};
  for (const MetricId id : compared_metrics) {
    if (id != chosen.key) {
      plan.metrics.push_back(id);
    }
  }
  LaneOptions lanes;
  lanes.lanes = {options.lanes.begin(), options.lanes.end()};
  StopConditions stop;
  if (plan.effort == Effort::mean_spp) {
    stop.spp = plan.goal;
  }
  std::ranges::copy(settings_of_lanes(lanes, options.run.lane_settings, stop), plan.lanes.begin());
  if (plan.lanes[0] == plan.lanes[1]) {
    throw UsageError(fmt::format("'{}' and '{}' are the same lane; two that differ would be right",
                                 options.lanes[0], options.lanes[1]));
  }
  return plan;
}

void run_versus_command(const VersusOptions& options, const Program& program) {
  const VersusPlan plan = versus_plan(options);
  check_seeds(options.run, plan.seeds);
  Run run = prepare_run(options.run, 2);
  check_rays({.rays = options.rays}, run.scene->scene());
  run.lab.statistics = {};
  OptionalFile csv(options.csv);
  const std::shared_ptr<const Reference> reference =
      chosen_or_made(options.reference, run, options.reference_spp, program.command_line);
  const SampleWorld world = sample_world(run.scene, run.settings, run.lab, image_of(reference));
  std::optional<VersusResult> result;
  {
    const Interrupt interrupt;
    Progress progress("versus");
    result = run_versus(world, plan, interrupt.token(), [&](double done, std::string_view detail) {
      progress.update(done, detail);
    });
  }
  if (!result) {
    throw Interrupted();
  }
  const VersusReport report{.run = run,
                            .plan = plan,
                            .result = *result,
                            .confidence = options.confidence,
                            .noise_floor = reference->noise_floor(MetricId::mse),
                            .command_line = program.command_line};
  csv.write([&] { return versus_csv(report); });
  if (options.json) {
    fmt::print("{}\n", versus_json(report));
  } else {
    fmt::print("{}", versus_text(report));
  }
  report_rejected(result->rejected, options.run, run.scene, run.settings);
  tell_if_capped(result->capped, CappedRun::most_of_many);
  tell_if_partial(result->partial, options.run);
}

}  // namespace

void add_versus_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "versus", "Whether one lane is better than another at equal effort, over seeds");
  const auto options = std::make_shared<VersusOptions>();
  command->add_option("A", options->lanes[0], "A lane, such as kl:0.004,mode=unbiased")->required();
  command->add_option("B", options->lanes[1], "Another, such as uniform")->required();
  add_run_options(*command, options->run);
  CLI::Option* const spp =
      add_number(*command, "--spp", options->spp, spp_range,
                 "Compare at this mean of samples per pixel; 32 if no effort is given");
  CLI::Option* const rays = add_number(*command, "--rays", options->rays, above_zero<double>,
                                       "Compare at this mean of rays per pixel");
  CLI::Option* const seconds = add_number(*command, "--seconds", options->seconds,
                                          above_zero<double>, "Compare at this as-if-alone time");
  spp->excludes(rays)->excludes(seconds);
  rays->excludes(seconds);
  add_seeds_option(*command, options->seeds, 2);
  add_number(*command, "--confidence", options->confidence, confidence_range,
             "Of all intervals together, such as 0.95");
  command->add_option("--metric", options->metric, "That the sentence speaks of: see quartet list")
      ->capture_default_str();
  add_reference_option(*command, options->reference);
  add_reference_spp_option(*command, options->reference_spp);
  command->add_option("--csv", options->csv, "Write every pass of each run as a .csv");
  command->add_flag("--json", options->json, "Print JSON instead of a table");
  command->footer(
      "Both lanes run over the same samples, seed by seed; ratios are geometric means with paired "
      "intervals.\n"
      "energy: mean luminance over the reference's, less 1. A lane that is too dark has lost "
      "light, "
      "which\nmost metrics take for a gain. bias² and variance are the two parts of its MSE.\n"
      "Examples:\n"
      "  quartet versus kl uniform cornell-checker --size 240x135\n"
      "  quartet versus kl kl:mode=unbiased cornell-checker --rays 100 --seeds 16 --json");
  command->callback([options, &program] { run_versus_command(*options, program); });
}

}  // namespace quartet
