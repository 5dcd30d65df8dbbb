#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>

#include "app/commands/commands.h"
#include "app/options/add_once.h"
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
#include "app/records/sweep_table.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/messages.h"
#include "app/terminal/progress.h"
#include "renderer/base/interval.h"
#include "renderer/base/stopwatch.h"
#include "renderer/base/table.h"
#include "renderer/files/staged_files.h"

namespace quartet {
namespace {

constexpr int verify_rounds = 5;

struct SweepOptions {
  RunOptions run;
  std::vector<std::string> estimators;  // none: all
  SweepPlan plan;
  std::string range = "0.1:10";
  std::string metric{quartet::metric(default_metric).id};
  std::string twins = "all";
  std::string effort;
  StopOptions stop;
  ReferenceChoice reference;
  std::uint32_t reference_spp = 1024;
  bool verify_time = false;
  std::string out;
};

/// Which twins, as a word.
struct TwinsWord {
  Twins key;
  std::string_view id;
};
constexpr std::array twins_words{TwinsWord{Twins::none, "none"},
                                 TwinsWord{Twins::at_defaults, "default"},
                                 TwinsWord{Twins::at_all, "all"}};

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
  // The baselines are in every sweep: uniform sampling with passes for its thresholds; what knows
  // the truth, so that it is seen how much there is to gain; and what loses light by design, so
  // that a gain of that kind is known when it is seen.
  for (const EstimatorId key : {EstimatorId::oracle, EstimatorId::uniform_clamp}) {
    add_once(lanes.estimators, std::string(estimator(key).id));
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
  plan.twins =
      find_row(std::span<const TwinsWord>(twins_words), options.twins, "choice of twins").key;
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

/// A line on stderr if bias² and variance are known at the ends of runs alone.
void tell_of_parts(const SweepResult& result, const SweepPlan& plan) {
  if (result.parts_at_ends_only) {
    constexpr double gib = double(1 << 30);
    warn(
        "bias² and variance of {} are those at the ends of the runs alone: on the way they take "
        "{:.1f} GiB, more than --memory; {} takes little",
        parts_metric(plan)->id, double(result.bytes_of_parts) / gib,
        metric(MetricId::relmse_regions).id);
  }
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
    if (run.seed == result.first_seed && run.lane.factor == 1.0 && !run.lane.twin) {
      points.push_back({run.lane.settings, run.end});
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

/// Halves the size until a sweep of all estimators ends within minutes, unless a size was asked for
/// or a file is compared with. Returns the options that give that size.
RunOptions with_sweep_size(const SweepOptions& options, Run& run) {
  constexpr std::int64_t enough = 160'000;  // pixels
  RunOptions sized = options.run;
  int& width = run.settings.width;
  int& height = run.settings.height;
  const std::string whole = fmt::format("{}x{}", width, height);
  if (sized.size.empty() && options.reference.empty()) {
    while (std::int64_t(width) * height > enough) {
      width = std::max(1, width / 2);
      height = std::max(1, height / 2);
    }
    sized.size = fmt::format("{}x{}", width, height);
    if (sized.size != whole) {
      tell("{} pixels, where the scene has {}; --size chooses", sized.size, whole);
    }
  }
  return sized;
}

void run_sweep_command(const SweepOptions& options, const Program& program) {
  const SweepPlan plan = sweep_plan(options);
  const EffortRow* const effort = options.effort.empty() ? nullptr : &find_effort(options.effort);
  check_seeds(options.run, plan.seeds);
  Run run = prepare_run(options.run, 1);
  const RunOptions sized = with_sweep_size(options, run);
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
  const SweepSummary summary =
      summarize(*result, plan, reference->noise_floor(plan.metrics.front()));
  const SweepReport report{run,
                           plan,
                           *result,
                           summary,
                           effort ? effort->key : summary.counted(),
                           reference->spp,
                           program.command_line};
  files.finish([&] { write_sweep_files(files, report); });
  fmt::print("{}", sweep_table(summary));
  print_savings(*result);
  fmt::print("{} are in {}\n", fmt::join(sweep_file_names(), ", "), options.out);
  tell_of_parts(*result, plan);
  report_rejected(result->rejected, sized, run.scene, run.settings);
  tell_if_capped(result->capped, CappedRun::most_of_many);
  if (options.verify_time) {
    verify_time(world, *result, interrupt.token());
  }
}

}  // namespace

void add_sweep_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "sweep", "Error, lost light, bias² and variance against effort, over thresholds and passes");
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
  command
      ->add_option("--twins", options->twins,
                   "Which lanes are also run in mode unbiased, their pilots charged: none, those "
                   "with default thresholds, or all")
      ->type_name("none|default|all")
      ->capture_default_str();
  command
      ->add_option("--axis", options->effort,
                   "What the charts are drawn over: seconds, rays or spp; rays if not given, which "
                   "are the same on every machine")
      ->type_name("seconds|rays|spp");
  add_stop_options(*command, options->stop);
  add_reference_option(*command, options->reference);
  add_reference_spp_option(*command, options->reference_spp);
  command->add_flag("--verify-time", options->verify_time,
                    "Rerun some points alone, without shared samples, and compare their time");
  add_out_option(*command, options->out);
  command->footer(
      "A line is a lane at fixed thresholds, the default ones times a factor, over its passes; it "
      "ends after 15\npasses, or at 64 mean samples per pixel, unless told otherwise. In every "
      "sweep there are baselines:\nuniform sampling, which goes on until it has taken as much as "
      "the dearest run; uniform-clamp, which loses\nlight by design; the unbiased twin of each "
      "lane, charged for its pilot; and the oracle,\nwhich knows the truth "
      "and is a bound, no method.\n"
      "Without --size and --reference a large scene is swept at half its size, or a quarter.\n"
      "Under the policy vote every pixel gets at least one sample a pass, so that the highest "
      "thresholds still\ncost what uniform sampling of as many passes does.\n"
      "Examples:\n"
      "  quartet sweep cornell-checker --size 480x270 --out sweep\n"
      "  quartet sweep veach-plates --estimators contrast,kl --thresholds 16 --seeds 5 "
      "--metric flip --out plates\n"
      "  quartet sweep cornell-checker --size 240x135 --twins default --axis seconds --out quick");
  command->callback([options, &program] { run_sweep_command(*options, program); });
}

}  // namespace quartet
