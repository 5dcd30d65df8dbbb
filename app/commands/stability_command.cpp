#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <tbb/task_arena.h>
#include "app/commands/commands.h"
#include "app/options/add_once.h"
#include "app/options/number_option.h"
#include "app/options/output_check.h"
#include "app/options/run_options.h"
#include "app/options/usage_error.h"
#include "app/records/rejected_report.h"
#include "app/records/stability_files.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "renderer/files/staged_files.h"
#include "renderer/scene/load_scene.h"

namespace quartet {
namespace {

struct StabilityCommand {
  std::vector<std::string> cases;
  std::vector<std::string> estimators;
  std::string policy = "batch";
  std::uint32_t seeds = StabilityOptions().seeds;
  double spp = StabilityOptions().spp;
  std::uint32_t truth_spp = StabilityOptions().truth.most_spp;
  double confidence = 0.95;
  RunOptions run;  // its sampler and threads
  std::string out;
};

StabilityOptions options_of(const StabilityCommand& command) {
  StabilityOptions options;
  for (const std::string& id : command.cases) {
    add_once(options.cases, &find_failure_case(id));
  }
  for (const FailureCase& row : failure_cases()) {
    if (command.cases.empty()) {
      options.cases.push_back(&row);
    }
  }
  for (const std::string& id : command.estimators) {
    const Estimator& row = find_estimator(id);
    if (row.channels == 0 || row.needs_reference) {
      throw UsageError(fmt::format(
          "--estimators: '{}' is what the others are compared with; name those to be studied", id));
    }
    add_once(options.estimators, row.key);
  }
  for (const Estimator& row : estimators()) {
    if (command.estimators.empty() && row.channels > 0 && !row.needs_reference) {
      options.estimators.push_back(row.key);
    }
  }
  options.policy = find_policy(command.policy).key;
  if (options.policy == PolicyId::vote) {
    throw UsageError(
        "--policy: 'vote' never stops sampling, so that none meets the budget; the second panel "
        "has "
        "it; choose batch, converge or two-level");
  }
  if (!command.run.sampler.empty()) {
    options.sampler = find_sampler(command.run.sampler).key;
  }
  options.seeds = command.seeds;
  options.spp = command.spp;
  options.truth.most_spp = command.truth_spp;
  return options;
}

/// One line a case that met samples which no film takes.
void report_rejected(const std::vector<CaseResult>& results) {
  for (const CaseResult& result : results) {
    RejectedCount most;
    for (const Trial& trial : result.trials) {
      if (trial.variation == Variation::none) {
        keep_most(most, trial.rejected);
      }
    }
    if (most.count > 0) {
      RunOptions options;
      options.scene = result.failure->scene;
      const auto scene = std::make_shared<const TraceScene>(open_scene(options.scene));
      RenderSettings settings = default_settings(scene->scene());
      if (settings.sampler != result.sampler) {
        options.sampler = sampler_row(result.sampler).id;
        settings.sampler = result.sampler;
      }
      report_rejected(most, options, scene, settings);
    }
  }
}

/// How many cases each column fails and by which rule, on each kind of terms.
void print_columns(const StabilityOptions& options, const StabilitySummary& summary) {
  for (const TermsRow& terms : terms_table()) {
    fmt::print("terms {}: cases that fail, of {}\n", terms.id, options.cases.size());
    std::map<std::string_view, std::map<std::string_view, int>> failed;
    std::vector<const Subject*> subjects;
    for (const Cell& cell : summary.cells) {
      if (cell.terms != terms.key) {
        continue;
      }
      if (!failed.contains(cell.subject.id)) {
        subjects.push_back(&cell.subject);
      }
      auto& of = failed[cell.subject.id];
      if (const Finding& found = cell.deciding(); found.verdict == Verdict::fails) {
        ++of[found.rule->label];
      }
    }
    for (const Subject* subject : subjects) {
      int all = 0;
      std::string how;
      for (const auto& [label, count] : failed[subject->id]) {
        all += count;
        how += fmt::format("{}{} {}", how.empty() ? "" : ", ", count, label);
      }
      fmt::print("  {:<16} {:3}  {}\n", subject->id, all, how);
    }
  }
}

/// Whether each planted mistake was found where it has to be.
void print_planted(const StabilitySummary& summary) {
  for (const Planted& planted : planted_mistakes()) {
    int looked = 0;
    std::string unseen;
    for (const Cell& cell : summary.cells) {
      if (cell.subject.id != planted.id || cell.terms != Terms::budget ||
          std::ranges::find(planted.cases, cell.failure->id) == planted.cases.end()) {
        continue;
      }
      ++looked;
      const auto found = std::ranges::find(cell.findings, planted.rule,
                                           [](const Finding& of) { return of.rule->id; });
      if (found->verdict != Verdict::fails) {
        unseen += fmt::format(" {}", cell.failure->id);
      }
    }
    if (looked > 0 && unseen.empty()) {
      fmt::print("planted {}: found in all {} cases where it has to be\n", planted.id, looked);
    } else if (looked > 0) {
      fmt::print("planted {}: not found in{}; with more --seeds smaller effects are seen\n",
                 planted.id, unseen);
    }
  }
}

void print_summary(const StabilityOptions& options, const StabilitySummary& summary) {
  print_columns(options, summary);
  print_planted(summary);
  int biased = 0;
  int twins = 0;
  for (const Cell& cell : summary.cells) {
    twins += cell.twin ? 1 : 0;
    biased += cell.twin && cell.twin->verdict == Verdict::fails ? 1 : 0;
  }
  fmt::print(
      "mode unbiased: {} of {} biased; {:.0f} findings together at a false-alarm rate of {:g}\n",
      biased, twins, summary.confidence.tests, summary.confidence.family);
}

void run_stability_command(const StabilityCommand& command, const Program& program) {
  const StabilityOptions options = options_of(command);
  const int threads = usable_threads(command.run);
  StagedFiles files(command.out, stability_file_names());
  std::vector<CaseResult> results;
  {
    const Interrupt interrupt;
    Progress progress("stability");
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
      results = run_stability(
          options, [&](double done, std::string_view what) { progress.update(done, what); },
          interrupt.token());
    });
    if (results.empty()) {
      throw Interrupted();
    }
  }
  const StabilitySummary summary = summarize(results, 1.0 - command.confidence);
  files.finish(
      [&] { write_stability_files(files, options, results, summary, program.command_line); });
  print_summary(options, summary);
  report_rejected(results);
}

}  // namespace

void add_stability_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "stability", "How each estimator fails: every one on every failure case over many seeds");
  const auto options = std::make_shared<StabilityCommand>();
  command
      ->add_option("--cases,--scenes", options->cases,
                   "Failure cases, separated by commas; all if not given, see quartet list")
      ->delimiter(',');
  command
      ->add_option("--estimators", options->estimators,
                   "Separated by commas; all if not given, see quartet list")
      ->delimiter(',');
  command
      ->add_option(
          "--policy", options->policy,
          "Of the first panel: batch, converge or two-level; the second has vote, as the window "
          "begins")
      ->capture_default_str();
  add_seeds_option(*command, options->seeds, 2);
  add_number(*command, "--spp", options->spp, {9.0, 8000.0},
             "The common budget, mean samples per pixel; a pixel may have 8 times as many");
  add_number(*command, "--truth-spp", options->truth_spp, {512, 1u << 24},
             "At most so many samples per pixel for what is compared with");
  add_number(*command, "--confidence", options->confidence, confidence_range,
             "Of all intervals together, such as 0.95");
  add_sampler_option(*command, options->run.sampler);
  add_threads_option(*command, options->run);
  add_out_option(*command, options->out);
  command->footer(
      "Writes matrix.png, matrix.pdf, stability.csv (one row a number, with its interval; of rules "
      "also "
      "the smallest\neffect that would have been seen) and "
      "trials.csv (one row a number and seed).\nRows cost_... and error_... of stability.csv: how "
      "mean samples and relmse change, as ratios, when thresholds are\nmultiplied or divided by "
      "1.1, when all radiance doubles, and when the resolution does; then the picture is shrunk\n"
      "back before it is compared, and the change is relative to that of uniform sampling.\n"
      "Examples:\n"
      "  quartet stability --out stability\n"
      "  quartet stability --cases rare-light,two-valued --estimators contrast,chi2 --seeds 32 "
      "--out stability");
  command->callback([options, &program] { run_stability_command(*options, program); });
}

}  // namespace quartet
