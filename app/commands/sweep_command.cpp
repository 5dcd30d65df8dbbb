#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/options/lane_option.h"
#include "app/options/number_option.h"
#include "app/options/output_check.h"
#include "app/options/reference_option.h"
#include "app/options/run_options.h"
#include "app/options/stop_options.h"
#include "app/options/usage_error.h"
#include "app/records/rejected_report.h"
#include "app/records/stop_report.h"
#include "app/records/sweep_files.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "renderer/base/interval.h"
#include "renderer/base/stopwatch.h"
#include "renderer/files/staged_files.h"
#include "renderer/measure/energy.h"
#include "renderer/view/sweep_charts.h"
#include "renderer/view/ticks.h"

namespace quartet {
namespace {

constexpr int verify_rounds = 5;

struct SweepOptions {
  RunOptions run;
  std::vector<std::string> estimators;  // none: all
  SweepPlan plan;
  std::string range = "0.1:10";
  std::string metric{quartet::metric(default_metric).id};
  StopOptions stop;
  ReferenceChoice reference;
  std::uint32_t reference_spp = 1024;
  bool verify_time = false;
  std::string out;
};

void parse_range(const std::string& text, SweepPlan& plan) {
  constexpr NumberRange<double> factors{1e-6, 1e6};
  const std::size_t colon = text.find(':');
  const auto low = number_in(std::string_view(text).substr(0, colon), factors);
  const auto high = number_in(
      colon == std::string::npos ? "" : std::string_view(text).substr(colon + 1), factors);
  if (!low || !high || *low >= *high) {
    throw UsageError(fmt::format(
        "--range: '{}' is no range of factors; write LOW:HIGH with LOW < HIGH, both from {}, such "
        "as 0.1:10",
        text, range_text(factors)));
  }
  plan.low = *low;
  plan.high = *high;
}

std::vector<LaneSettings> sweep_lanes(const SweepOptions& options, const StopConditions& stop) {
  LaneOptions lanes;
  lanes.estimators = options.estimators;
  if (lanes.estimators.empty()) {
    for (const Estimator& row : estimators()) {
      lanes.estimators.emplace_back(row.id);
    }
  }
  // The baselines are in every sweep: uniform sampling with passes for its thresholds, and what
  // loses light by design, so that a gain of that kind is known when it is seen.
  const std::string clamp(estimator(EstimatorId::uniform_clamp).id);
  if (std::ranges::find(lanes.estimators, clamp) == lanes.estimators.end()) {
    lanes.estimators.push_back(clamp);
  }
  std::vector<LaneSettings> lane_settings =
      settings_of_lanes(lanes, options.run.lane_settings, stop);
  std::erase_if(lane_settings, [](const LaneSettings& settings) {
    return settings.estimator == EstimatorId::uniform;
  });
  return lane_settings;
}

SweepPlan sweep_plan(const SweepOptions& options) {
  SweepPlan plan = options.plan;
  parse_range(options.range, plan);
  plan.stop = stop_conditions(options.stop, true);
  plan.lane_settings = sweep_lanes(options, plan.stop);
  // Beside what else is given.
  plan.stop.passes = plan.stop.passes.value_or(15);
  plan.stop.spp = plan.stop.spp.value_or(64.0);
  plan.metrics = {find_metric(options.metric).key};
  for (const MetricId id :
       {MetricId::relmse_regions, MetricId::relmse, MetricId::mse, MetricId::flip}) {
    if (id != plan.metrics.front()) {
      plan.metrics.push_back(id);
    }
  }
  return plan;
}

std::string seed_text(std::uint32_t seeds) {
  return seeds == 1 ? "1 seed" : fmt::format("{} seeds", seeds);
}

void print_points(const SweepSummary& summary) {
  const Metric& row = metric(summary.metric);
  // Rays are counted, so that what is called best is the same on every machine.
  const bool traced = summary.uniform.back().mean_rays > 0.0;
  const auto counted = std::size_t(traced ? Effort::rays : Effort::mean_spp);
  fmt::print(
      "energy: mean luminance over the reference's, less 1. Of uniform: the error over that of\n"
      "uniform sampling run to as many {}, and as many seconds; below 1 the estimator gains, if\n"
      "its energy is right.\n",
      traced ? "rays" : "samples");
  fmt::print("{:<22} {:>9} {:>9} {:>9} {:>11} {:>9} {:>11} {:>11}\n", "", "", "", "", "", "",
             "of uniform,", "of uniform,");
  fmt::print("{:<22} {:>9} {:>9} {:>9} {:>11} {:>9} {:>11} {:>11}\n", "estimator", "factor",
             "mean spp", "seconds", row.id, "energy", traced ? "rays" : "samples", "seconds");
  for (std::size_t begin = 0; begin < summary.points.size();) {
    const EstimatorId id = summary.points[begin].settings.estimator;
    const SweepPoint* normal = nullptr;
    const SweepPoint* best = &summary.points[begin];
    std::size_t end = begin;
    for (; end < summary.points.size() && summary.points[end].settings.estimator == id; ++end) {
      const SweepPoint& point = summary.points[end];
      normal = point.factor == 1.0 ? &point : normal;
      best = point.against_uniform[counted] < best->against_uniform[counted] ? &point : best;
    }
    const auto print = [&](std::string_view label, const SweepPoint& point, std::string_view note) {
      fmt::print("{:<22} {:>9.3g} {:>9.2f} {:>9.3f} {:>11.4g} {:>9} {:>11.3f} {:>11.3f}   {}\n",
                 label, point.factor, point.mean_spp, point.seconds, point.error,
                 energy_text(point.energy), point.against_uniform[counted],
                 point.against_uniform[std::size_t(Effort::seconds)], note);
    };
    print(estimator(id).label, *normal,
          estimator(id).channels > 0 ? "at its default threshold" : "which loses light by design");
    if (best->against_uniform[counted] < normal->against_uniform[counted]) {
      print("", *best, "at the best of the sweep");
    }
    begin = end;
  }
  const SweepPoint& uniform = summary.uniform.back();
  fmt::print("{:<22} {:>9} {:>9.2f} {:>9.3f} {:>11.4g} {:>9} {:>11.3f} {:>11.3f}\n", "uniform", "",
             uniform.mean_spp, uniform.seconds, uniform.error, energy_text(uniform.energy), 1.0,
             1.0);
}

void print_savings(const SweepResult& result) {
  fmt::print("traced samples / samples used: {} / {} = {:.4f}{}\n", result.samples_traced,
             result.samples_used, double(result.samples_traced) / double(result.samples_used),
             result.partial ? "; some were traced again: a larger --memory would keep them" : "");
}

/// Reruns every lane at its default thresholds, and the baseline: out of shared samples, as the
/// sweep did, and each alone, in turn, because the speed of a machine drifts. Compares what a user
/// waits with what is charged, by the medians of some rounds.
void verify_time(const SampleWorld& world, const SweepResult& result, std::stop_token stop) {
  struct Point {
    LaneSettings settings;
    Measurement end;
    std::vector<double> charged = {};
    std::vector<double> alone = {};

    /// Runs it as far as the sweep did, and returns what that is charged with.
    double seconds(Experiment& experiment, std::stop_token stop) const {
      const auto run =
          experiment.run({.settings = settings, .stop = {.passes = end.record.pass}}, stop);
      if (!run) {
        throw Interrupted();
      }
      return run->back().record.seconds;
    }
  };
  std::vector<Point> points{
      {default_settings(EstimatorId::uniform), result.uniform.front().back()}};
  for (const SweepRun& run : result.runs) {
    if (run.seed == result.first_seed && run.factor == 1.0) {
      points.push_back({run.settings, run.end});
    }
  }
  for (int round = 0; round < verify_rounds; ++round) {
    Experiment shared = make_experiment(world, world.first_seed);
    for (Point& point : points) {
      point.charged.push_back(point.seconds(shared, stop));
      Experiment own = make_experiment(world, world.first_seed);
      const Stopwatch watch;
      point.seconds(own, stop);
      point.alone.push_back(watch.seconds());
    }
  }
  fmt::print("\n{:<22} {:>9} {:>14} {:>14} {:>11}\n", "estimator", "mean spp", "as if alone, s",
             "alone, s", "difference");
  double sum = 0.0;
  double absolute = 0.0;
  for (const Point& point : points) {
    const double charged = median(point.charged);
    const double alone = median(point.alone);
    const double difference = charged / alone - 1.0;
    fmt::print("{:<22} {:>9.2f} {:>14.3f} {:>14.3f} {:>+9.1f} %\n",
               estimator(point.settings.estimator).label, point.end.mean_spp, charged, alone,
               100.0 * difference);
    sum += difference;
    absolute += std::abs(difference);
  }
  const auto count = double(points.size());
  fmt::print("as-if-alone time is off by {:+.1f} % on average, {:.1f} % in absolute terms{}\n",
             100.0 * sum / count, 100.0 * absolute / count,
             std::abs(sum) <= 0.05 * count ? "" : ": more than the 5 % that are promised");
}

void run_sweep_command(const SweepOptions& options, const Program& program) {
  const SweepPlan plan = sweep_plan(options);
  check_seeds(options.run, plan.seeds);
  Run run = prepare_run(options.run, 1);
  check_rays(plan.stop, run.scene->scene());
  // Variances would cost every run memory and time, and no estimator that does not ask for them.
  run.lab.statistics = {};
  StagedFiles files(options.out, sweep_file_names());
  const std::shared_ptr<const Reference> reference =
      chosen_or_made(options.reference, run, options.reference_spp, program.command_line);
  const SampleWorld world = sample_world(run.scene, run.settings, run.lab, image_of(reference));
  const Interrupt interrupt;
  std::optional<SweepResult> result;
  {
    Progress progress("sweep");
    result = run_sweep(world, plan, interrupt.token(), [&](double done, std::string_view detail) {
      progress.update(done, detail);
    });
  }
  if (!result) {
    throw Interrupted();
  }
  const SweepReport report{run,
                           plan,
                           *result,
                           reference->noise_floor(plan.metrics.front()),
                           reference->spp,
                           program.command_line};
  files.finish([&] { write_sweep_files(files, report); });
  print_points(summarize(*result, plan, 0, report.noise_floor));
  print_savings(*result);
  fmt::print("sweep and calibration as .csv, .png, .pdf and .svg are in {}; median of {}\n",
             options.out, seed_text(plan.seeds));
  report_rejected(result->rejected, options.run, run.scene, run.settings);
  tell_if_capped(result->capped, CappedRun::most_of_many);
  if (options.verify_time) {
    verify_time(world, *result, interrupt.token());
  }
}

}  // namespace

void add_sweep_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "sweep", "Error against time and samples for every estimator over a range of thresholds");
  const auto options = std::make_shared<SweepOptions>();
  add_run_options(*command, options->run);
  command
      ->add_option("--estimators", options->estimators,
                   "Which, separated by commas; all if not given. uniform is always the baseline")
      ->delimiter(',');
  add_number(*command, "--thresholds", options->plan.thresholds, {1, 1000},
             "Points of each curve; the default threshold is added where it is none of them");
  command->add_option("--range", options->range, "Factors on the default thresholds")
      ->type_name("LOW:HIGH")
      ->capture_default_str();
  add_seeds_option(*command, options->plan.seeds);
  command->add_option("--metric", options->metric, "Of the chart: see quartet list")
      ->capture_default_str();
  add_stop_options(*command, options->stop);
  add_reference_option(*command, options->reference);
  add_reference_spp_option(*command, options->reference_spp);
  command->add_flag("--verify-time", options->verify_time,
                    "Rerun some points alone, without shared samples, and compare their time");
  add_out_option(*command, options->out);
  command->footer(
      "A point of a curve is where a run ends with the default thresholds times a factor: after "
      "15 passes,\nor at 64 mean samples per pixel, unless told otherwise. Under the policy vote "
      "every pixel gets at\nleast one sample a pass, so that the highest thresholds still cost "
      "what uniform sampling of as many\npasses does. The baseline goes on until it has taken as "
      "much as the dearest run.\n"
      "Examples:\n"
      "  quartet sweep cornell-checker --size 480x270 --out sweep\n"
      "  quartet sweep veach-plates --estimators contrast,kl --thresholds 16 --seeds 5 "
      "--metric flip --out plates");
  command->callback([options, &program] { run_sweep_command(*options, program); });
}

}  // namespace quartet
