#include "app/records/stability_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "tests/files/temp_folder.h"
#include "tests/records/study_cases.h"

namespace quartet {
namespace {

/// Column i of an outcome is first + i.
Outcome counted_outcome(double first) {
  Outcome outcome;
  for (std::size_t i = 0; i < outcome_columns().size(); ++i) {
    outcome.*outcome_columns()[i].value = first + double(i);
  }
  return outcome;
}

StabilityOptions counted_options() {
  StabilityOptions options;
  options.cases = {&find_failure_case("two-valued")};
  options.estimators = {EstimatorId::kl};
  options.policy = PolicyId::two_level;
  return options;
}

CaseResult counted_case() {
  CaseResult result;
  result.failure = &find_failure_case("two-valued");
  result.truth.spp = 512;
  result.truth.noise = 0.0078125;
  result.limit = 0.03125;
  result.width = 10;
  result.height = 5;
  result.subjects = {{"kl", Role::studied, test::kl_settings(0.25f)},
                     {"lucky", Role::planted, test::kl_settings(0.5f)}};
  Trial trial;
  trial.failure = result.failure;
  trial.subject = "kl";
  trial.settings = test::kl_settings(0.25f, SampleMode::unbiased);
  trial.settings.policy.kind = PolicyId::two_level;
  trial.terms = Terms::budget;
  trial.variation = Variation::exposure;
  trial.seed = 3;
  trial.passes = 6;
  trial.outcome = counted_outcome(100.0);
  trial.outcome.missed = Outcome::unknown;
  result.trials.push_back(trial);
  trial.subject = "uniform";
  trial.settings = default_settings(EstimatorId::uniform);
  trial.terms = Terms::window;
  trial.variation = Variation::resolution;
  trial.seed = 4;
  trial.passes = 7;
  trial.outcome = counted_outcome(200.0);
  result.trials.push_back(trial);
  return result;
}

Interval around(double value) {
  return {value, value - 0.25, value + 0.5};
}

Finding found(std::size_t rule, double value, Verdict verdict) {
  return {&rules()[rule], around(value), value + 0.125, verdict};
}

/// A cell whose every number is another, from `first` on.
Cell counted_cell(double first, Terms terms) {
  Cell cell;
  cell.failure = &find_failure_case("two-valued");
  cell.terms = terms;
  cell.subject = {"kl", Role::studied, test::kl_settings(terms == Terms::window ? 0.5f : 0.25f)};
  cell.subject.settings.policy.kind = terms == Terms::window ? PolicyId::vote : PolicyId::two_level;
  cell.findings = {found(0, first + 1, Verdict::fails), found(1, first + 2, Verdict::open),
                   found(3, first + 3, Verdict::keeps)};
  for (std::size_t i = 0; i < outcome_columns().size(); ++i) {
    cell.values.push_back(around(first + 10 + double(i)));
  }
  cell.audit = around(first + 50);
  cell.audited = first + 51;
  cell.cost_spread = first + 54;
  cell.error_spread = first + 55;
  if (terms == Terms::budget) {
    cell.twin = found(0, first + 4, Verdict::keeps);
    cell.price = first + 53;
    cell.changes[std::size_t(Variation::threshold_up)] = Change{first + 60, first + 61};
    cell.changes[std::size_t(Variation::threshold_down)] = Change{first + 62, first + 63};
    cell.changes[std::size_t(Variation::exposure)] = Change{first + 64, first + 65};
    cell.changes[std::size_t(Variation::resolution)] = Change{first + 66, first + 67};
  }
  return cell;
}

/// "id,value,low,high,," for each column of an outcome.
std::vector<std::string> column_rows(const std::string& row, double first) {
  constexpr std::array ids{"mean_spp",
                           "seconds",
                           "relmse",
                           "worst",
                           "fireflies",
                           "energy",
                           "region_energy",
                           "done",
                           "missed",
                           "never_done",
                           "never_done_cost",
                           "wasted",
                           "off_oracle",
                           "region_spp",
                           "rejected",
                           "mean_rays",
                           "relmse_regions",
                           "over_uniform",
                           "over_uniform_rays",
                           "too_early",
                           "off"};
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const double value = first + double(i);
    rows.push_back(fmt::format("{}{},{},{},{},,", row, ids[i], value, value - 0.25, value + 0.5));
  }
  return rows;
}

TEST(StabilityFiles, EveryColumnHoldsItsOwnNumber) {
  const TempFolder folder;
  StabilitySummary summary;
  summary.cells = {counted_cell(100, Terms::window), counted_cell(200, Terms::budget)};
  const std::vector<CaseResult> results{counted_case()};
  {
    StagedFiles files(folder.path());
    write_stability_files(files, counted_options(), results, summary, "quartet stability");
    files.commit();
  }
  const std::string window =
      "two-valued,failures/two-valued,sobol,kl,studied,kl,vote,window,0.5,0.03125,512,0.0078125,";
  const std::string budget =
      "two-valued,failures/"
      "two-valued,sobol,kl,studied,kl,two-level,budget,0.25,0.03125,512,0.0078125,";
  std::vector<std::string> expected{
      "case,scene,sampler,subject,role,estimator,policy,terms,thresholds,limit,truth_spp,"
      "truth_noise,metric,value,low,high,visible,verdict",
      window + "rule_biased,101,100.75,101.5,101.125,fails",
      window + "rule_misses,102,101.75,102.5,102.125,open",
      window + "rule_worse,103,102.75,103.5,103.125,keeps"};
  std::ranges::move(column_rows(window, 110.0), std::back_inserter(expected));
  std::ranges::move(
      std::vector<std::string>{window + "missed_by_audit,150,149.75,150.5,,",
                               window + "audited,151,,,,", window + "cost_spread,154,,,,",
                               window + "error_spread,155,,,,",
                               budget + "rule_biased,201,200.75,201.5,201.125,fails",
                               budget + "rule_misses,202,201.75,202.5,202.125,open",
                               budget + "rule_worse,203,202.75,203.5,203.125,keeps",
                               budget + "rule_biased_unbiased,204,203.75,204.5,204.125,keeps",
                               budget + "price_of_unbiased,253,,,,"},
      std::back_inserter(expected));
  std::ranges::move(column_rows(budget, 210.0), std::back_inserter(expected));
  std::ranges::move(
      std::vector<std::string>{
          budget + "missed_by_audit,250,249.75,250.5,,", budget + "audited,251,,,,",
          budget + "cost_spread,254,,,,", budget + "error_spread,255,,,,",
          budget + "cost_threshold_up,260,,,,", budget + "error_threshold_up,261,,,,",
          budget + "cost_threshold_down,262,,,,", budget + "error_threshold_down,263,,,,",
          budget + "cost_exposure,264,,,,", budget + "error_exposure,265,,,,",
          budget + "cost_resolution,266,,,,", budget + "error_resolution,267,,,,"},
      std::back_inserter(expected));
  test::expect_lines(bytes_of(folder / "stability.csv"), expected);
  // 50 pixels, and four times as many at twice the resolution.
  const std::string kl =
      "two-valued,failures/"
      "two-valued,sobol,kl,kl,two-level,unbiased,budget,exposure,0.25,3,6,101.000000,"
      "5750,5000,100.000000,";
  const std::string uniform =
      "two-valued,failures/"
      "two-valued,sobol,uniform,uniform,vote,reuse,window,resolution,,4,7,201.000000,"
      "43000,40000,200.000000,";
  std::vector<std::string> trials{
      "case,scene,sampler,subject,estimator,policy,mode,terms,variation,thresholds,seed,pass,"
      "seconds,rays,samples,mean_spp,metric,value"};
  const auto add = [&](const std::string& row, double first, std::string_view left_out) {
    for (std::size_t i = 2; i < outcome_columns().size(); ++i) {
      const std::string_view id = outcome_columns()[i].id;
      if (id != "mean_rays" && id != left_out) {
        trials.push_back(fmt::format("{}{},{}", row, id, first + double(i)));
      }
    }
  };
  add(kl, 100.0, "missed");
  add(uniform, 200.0, "");
  test::expect_lines(bytes_of(folder / "trials.csv"), trials);
}

}  // namespace
}  // namespace quartet
