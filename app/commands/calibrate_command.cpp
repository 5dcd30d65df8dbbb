#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/commands/commands.h"
#include "app/options/lane_option.h"
#include "app/options/number_option.h"
#include "app/options/reference_option.h"
#include "app/options/run_options.h"
#include "app/options/stop_options.h"
#include "app/options/usage_error.h"
#include "app/records/json_text.h"
#include "app/records/rejected_report.h"
#include "app/records/stop_report.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/terminal/shell_words.h"
#include "renderer/measure/energy.h"
#include "renderer/study/calibrate.h"

namespace quartet {
namespace {

struct CalibrateOptions {
  RunOptions run;
  LaneOptions lanes;
  CommonBudget budget;
  std::optional<std::uint32_t> passes;
  std::string error;
  ReferenceChoice reference;
  std::uint32_t reference_spp = 1024;
  bool json = false;
};

CommonBudget budget_of(const CalibrateOptions& options) {
  CommonBudget budget = options.budget;
  budget.passes = options.passes.value_or(budget.passes);
  if (!options.error.empty()) {
    budget.error = parse_error_target(options.error);
  }
  const int given =
      int(budget.spp.has_value()) + int(budget.seconds.has_value()) + int(budget.error.has_value());
  if (given != 1) {
    throw UsageError(
        fmt::format("{} budget{} given; give one of --spp N, --seconds T and --error METRIC=VALUE",
                    given == 0 ? "no" : "more than one", given == 0 ? "" : "s are"));
  }
  return budget;
}

/// What was found, a row of the table each.
struct Calibrations {
  std::vector<Calibration> asked;
  std::optional<Calibration> baseline;  ///< uniform, where it was not asked for

  std::vector<Calibration> rows() const {
    std::vector<Calibration> all = asked;
    if (baseline) {
      all.push_back(*baseline);
    }
    return all;
  }
};

bool is_uniform(const LaneSettings& settings) {
  return settings.estimator == EstimatorId::uniform;
}

/// Passes in which uniform has its chance to reach an error: many times what the lanes took.
std::uint32_t baseline_passes(const std::vector<Calibration>& asked) {
  constexpr double times = 8.0;
  double most = 32.0;
  for (const Calibration& each : asked) {
    most = std::max(most, each.result.mean_spp);
  }
  return std::uint32_t(std::min(std::ceil(times * most), double(CommonBudget().uniform_passes)));
}

Calibrations calibrate_all(Experiment& experiment, const std::vector<LaneSettings>& lane_settings,
                           const CommonBudget& budget) {
  const Interrupt interrupt;
  Progress progress("calibrating");
  Calibrations found;
  const bool with_baseline = std::ranges::none_of(lane_settings, is_uniform);
  const auto calibrated = [&](const LaneSettings& settings, const CommonBudget& within) {
    progress.update(
        double(found.asked.size()) / double(lane_settings.size() + (with_baseline ? 1 : 0)),
        estimator(settings.estimator).id);
    auto calibration = calibrate(experiment, settings, within, interrupt.token());
    if (!calibration) {
      throw Interrupted();
    }
    return std::move(*calibration);
  };
  for (const LaneSettings& settings : lane_settings) {
    found.asked.push_back(calibrated(settings, budget));
  }
  if (with_baseline) {
    CommonBudget within = budget;
    if (budget.error) {
      within.uniform_passes = baseline_passes(found.asked);
    }
    found.baseline = calibrated(default_settings(EstimatorId::uniform), within);
  }
  return found;
}

std::string thresholds_of(const LaneSettings& settings) {
  const Estimator& row = estimator(settings.estimator);
  std::string text = row.channels == 0 ? "none" : "";
  for (int c = 0; c < row.channels; ++c) {
    text += fmt::format("{}{:.6g}", c > 0 ? ", " : "", settings.thresholds[std::size_t(c)]);
  }
  return text;
}

/// The words after "quartet figure SCENE" that show all of them side by side.
std::string lanes_text(const std::vector<Calibration>& found, std::uint32_t passes) {
  std::string words = fmt::format("--passes {}", passes);
  for (const Calibration& each : found) {
    words += " --lane " + shell_word(lane_text(each.settings));
  }
  return words;
}

bool is_comparable(const Calibration& each) {
  return each.met && estimator(each.settings.estimator).channels > 0;
}

/// "contrast, kl" of those that a rule holds for.
template <class Rule>
std::string ids_of(const std::vector<Calibration>& found, const Rule& rule) {
  std::vector<std::string_view> ids;
  for (const Calibration& each : found) {
    if (rule(each)) {
      ids.push_back(estimator(each.settings.estimator).id);
    }
  }
  return fmt::format("{}", fmt::join(ids, ", "));
}

std::string ids_of_unmet(const std::vector<Calibration>& found) {
  return ids_of(found, [](const Calibration& each) { return !each.met; });
}

/// What the printed command lacks, as a comment of a shell; empty if it has all.
std::string missing_text(const std::vector<Calibration>& found, const CommonBudget& budget) {
  const std::string unmet = ids_of_unmet(found);
  const std::string plain =
      ids_of(found, [](const Calibration& each) { return each.met && !is_comparable(each); });
  std::string text;
  if (!unmet.empty()) {
    text = fmt::format("without {}: cannot meet {}", unmet, budget.text());
  }
  if (!plain.empty()) {
    text += fmt::format("{}without {}: no threshold", text.empty() ? "" : "; ", plain);
  }
  return text.empty() ? "" : "  # " + text;
}

/// What the table cannot show, a line a lane.
void print_remarks(const Calibrations& found, const CommonBudget& budget) {
  for (const Calibration& each : found.asked) {
    const std::string_view id = estimator(each.settings.estimator).id;
    if (!each.met) {
      fmt::print("{}: {} cannot be met: {}\n", id, budget.text(), each.reason);
    } else if (!each.note.empty()) {
      fmt::print("{}: {}\n", id, each.note);
    }
  }
  if (found.baseline && !found.baseline->met) {
    fmt::print("uniform, for comparison: {}\n", found.baseline->reason);
  }
}

void print_table(const Calibrations& found, const CommonBudget& budget,
                 const CalibrateOptions& options) {
  fmt::print(
      "{:<22} {:>9} {:<30} {:>6} {:>9} {:>9}{}\n", "estimator", "factor", "thresholds", "passes",
      "mean spp", "seconds",
      budget.error ? fmt::format(" {:>11} {:>10}", metric(budget.error->metric).id, "energy") : "");
  for (const Calibration& each : found.rows()) {
    fmt::print("{:<22} {:>9.4g} {:<30} {:>6} {:>9.2f} {:>9.3f}{}\n",
               estimator(each.settings.estimator).label, each.factor, thresholds_of(each.settings),
               each.result.record.pass, each.result.mean_spp, each.result.record.seconds,
               budget.error ? fmt::format(" {:>11.4g} {:>10}", each.result.values.front(),
                                          energy_text(each.result.energy))
                            : "");
  }
  print_remarks(found, budget);
  // What has no threshold, or none that does, is nothing to compare like with like.
  std::vector<Calibration> comparable = found.asked;
  std::erase_if(comparable, [](const Calibration& each) { return !is_comparable(each); });
  if (!comparable.empty()) {
    fmt::print("quartet figure {} {} --out DIR{}\n", scene_words(options.run),
               lanes_text(comparable, budget.passes), missing_text(found.asked, budget));
  }
}

/// Throws UsageError for an option that no lane's search looks at.
void check_use(const CalibrateOptions& options, std::span<const LaneSettings> lane_settings,
               const CommonBudget& budget) {
  const auto has_threshold = [](const LaneSettings& settings) {
    return estimator(settings.estimator).channels > 0;
  };
  if (options.passes && std::ranges::none_of(lane_settings, has_threshold)) {
    throw UsageError(
        "--passes has no effect: without a threshold, as many passes are run as meet the budget");
  }
  const auto needs_reference = [](const LaneSettings& settings) {
    return estimator(settings.estimator).needs_reference;
  };
  if (!options.reference.empty() && !budget.error &&
      std::ranges::none_of(lane_settings, needs_reference)) {
    throw UsageError("--reference has no effect: it is for --error, and for the estimator oracle");
  }
}

nlohmann::ordered_json json_of(const Calibration& found, bool baseline,
                               const CommonBudget& budget) {
  const Estimator& row = estimator(found.settings.estimator);
  nlohmann::ordered_json entry;
  entry["estimator"] = row.id;
  entry["baseline"] = baseline;  // not asked for; there to compare with
  entry["met"] = found.met;
  if (!found.met) {
    entry["reason"] = found.reason;
  }
  if (!found.note.empty()) {
    entry["note"] = found.note;
  }
  entry["factor"] = found.factor;
  entry["thresholds"] = std::vector<float>(found.settings.thresholds.begin(),
                                           found.settings.thresholds.begin() + row.channels);
  entry["passes"] = found.result.record.pass;
  entry["mean_spp"] = found.result.mean_spp;
  entry["rays"] = found.result.record.rays;
  entry["seconds"] = found.result.record.seconds;
  if (budget.error) {
    entry[std::string(metric(budget.error->metric).id)] = found.result.values.front();
    entry["energy_error"] = found.result.energy;
  }
  entry["runs"] = found.runs;
  entry["lane"] = lane_text(found.settings);
  return entry;
}

std::string json_of(const Calibrations& found, const CommonBudget& budget, const Run& run,
                    const std::string& command_line) {
  nlohmann::ordered_json json;
  json["scene"] = run.scene->scene().name;
  json["sampler"] = sampler_row(run.settings.sampler).id;
  json["command_line"] = command_line;
  json["budget"] = budget.text();
  json["passes"] = budget.passes;
  json["estimators"] = nlohmann::ordered_json::array();
  for (const Calibration& each : found.asked) {
    json["estimators"].push_back(json_of(each, false, budget));
  }
  if (found.baseline) {
    json["estimators"].push_back(json_of(*found.baseline, true, budget));
  }
  return json_text(json);
}

void run_calibrate(const CalibrateOptions& options, const Program& program) {
  const CommonBudget budget = budget_of(options);
  const std::vector<LaneSettings> lane_settings = settings_of_lanes(
      options.lanes, options.run.lane_settings, {.passes = options.passes, .spp = budget.spp});
  check_use(options, lane_settings, budget);
  Run run = prepare_run(options.run, 1);
  run.lab.statistics = {};
  const std::shared_ptr<const Reference> reference =
      budget.error
          ? chosen_or_made(options.reference, run, options.reference_spp, program.command_line)
          : reference_at(options.reference, run);
  run.lab.reference = truth_for(lane_settings, reference);
  Experiment experiment(sample_source(run.scene, run.settings), run.settings.width,
                        run.settings.height, run.lab, image_of(reference));
  const Calibrations found = calibrate_all(experiment, lane_settings, budget);
  if (options.json) {
    fmt::print("{}\n", json_of(found, budget, run, program.command_line));
  } else {
    print_table(found, budget, options);
  }
  report_rejected(rejected_of(experiment.lane(), run.settings.seed), options.run, run.scene,
                  run.settings);
  for (const Calibration& each : found.asked) {
    tell_if_capped(each.capped);
  }
  tell_if_partial(experiment.store().partial(), options.run);
  if (const std::string unmet = ids_of_unmet(found.asked); !unmet.empty()) {
    throw std::runtime_error(fmt::format("{} cannot be met by {}", budget.text(), unmet));
  }
}

}  // namespace

void add_calibrate_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "calibrate", "Thresholds that give every estimator the same samples, time or error");
  const auto options = std::make_shared<CalibrateOptions>();
  add_run_options(*command, options->run);
  add_lane_options(*command, options->lanes);
  add_number(*command, "--spp", options->budget.spp, spp_range,
             "The same mean of samples per pixel");
  add_number(*command, "--seconds", options->budget.seconds, above_zero<double>,
             "The same as-if-alone time");
  CLI::Option* const error =
      command->add_option("--error", options->error, "The same error, such as relmse=0.01")
          ->type_name("METRIC=VALUE");
  add_number(*command, "--passes,--frames", options->passes, {1, 10'000'000},
             fmt::format("Passes to take it in; {} if not given", CommonBudget().passes));
  add_reference_option(*command, options->reference);
  add_reference_spp_option(*command, options->reference_spp)->needs(error);
  command->add_flag("--json", options->json, "Print JSON instead of a table");
  command->footer(
      "All thresholds of an estimator are scaled by one factor, found by replays: by bisection for "
      "samples\nand time; by a scan for an error, which is an upper bound and may rise where a "
      "threshold falls: of the\nthresholds that meet it, the one of the fewest rays. Uniform, in "
      "whole passes, is always a row. Under the\npolicy vote every pixel gets at least one sample "
      "a pass, so that --passes samples a pixel are the least.\n"
      "Exit status 1 if a lane that was asked for cannot meet the goal; all are still printed, and "
      "the figure\ncommand leaves it out.\n"
      "Examples:\n"
      "  quartet calibrate cornell-checker --spp 24\n"
      "  quartet calibrate veach-plates --error relmse=0.01 --passes 30 --json");
  command->callback([options, &program] { run_calibrate(*options, program); });
}

}  // namespace quartet
