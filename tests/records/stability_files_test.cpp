#include "app/records/stability_files.h"

#include <gtest/gtest.h>

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
  result.width = 10;
  result.height = 5;
  Trial trial;
  trial.failure = result.failure;
  trial.settings = test::kl_settings(0.25f, SampleMode::unbiased);
  trial.tuning = Tuning::budget;
  trial.variation = Variation::exposure;
  trial.seed = 3;
  trial.passes = 6;
  trial.outcome = counted_outcome(100.0);
  trial.outcome.missed = Outcome::unknown;
  result.trials.push_back(trial);
  trial.settings = default_settings(EstimatorId::uniform);
  trial.tuning = Tuning::usual;
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

/// A cell whose every number is another, from `first` on.
Cell counted_cell(double first, Tuning tuning) {
  Cell cell;
  cell.failure = &find_failure_case("two-valued");
  cell.tuning = tuning;
  cell.settings = test::kl_settings(tuning == Tuning::usual ? 0.5f : 0.25f);
  cell.picture = {around(first + 1), 0.01};
  cell.region = {around(first + 2), 0.02};
  cell.unbiased_picture = {around(first + 3), 0.03};
  cell.unbiased_region = {around(first + 4), 0.04};
  for (std::size_t i = 0; i < outcome_columns().size(); ++i) {
    cell.values.push_back(around(first + 10 + double(i)));
  }
  cell.audit = around(first + 30);
  cell.audited = first + 31;
  cell.equal_time = around(first + 32);
  cell.price = first + 33;
  cell.cost_spread = first + 34;
  cell.error_spread = first + 35;
  if (tuning == Tuning::budget) {
    cell.changes[std::size_t(Variation::threshold_up)] = Change{first + 40, first + 41};
    cell.changes[std::size_t(Variation::threshold_down)] = Change{first + 42, first + 43};
    cell.changes[std::size_t(Variation::exposure)] = Change{first + 44, first + 45};
    cell.changes[std::size_t(Variation::resolution)] = Change{first + 46, first + 47};
  }
  return cell;
}

TEST(StabilityFiles, EveryColumnHoldsItsOwnNumber) {
  const TempFolder folder;
  StabilitySummary summary;
  summary.cells = {counted_cell(100, Tuning::usual), counted_cell(200, Tuning::budget)};
  const std::vector<CaseResult> results{counted_case()};
  {
    StagedFiles files(folder.path());
    write_stability_files(files, counted_options(), results, summary, "quartet stability");
    files.commit();
  }
  const std::string usual =
      "two-valued,failures/two-valued,sobol,kl,two-level,default,0.5,512,0.0078125,";
  const std::string budget =
      "two-valued,failures/two-valued,sobol,kl,two-level,budget,0.25,512,0.0078125,";
  test::expect_lines(
      bytes_of(folder / "stability.csv"),
      {
          ("case,scene,sampler,estimator,policy,tuning,thresholds,truth_spp,truth_noise,metric,"
           "value,low,high,p"),
          usual + "verdict,biased,,,",
          usual + "bias,101,100.75,101.5,0.01",
          usual + "region_bias,102,101.75,102.5,0.02",
          usual + "unbiased_bias,103,102.75,103.5,0.03",
          usual + "unbiased_region_bias,104,103.75,104.5,0.04",
          usual + "mean_spp,110,109.75,110.5,",
          usual + "seconds,111,110.75,111.5,",
          usual + "relmse,112,111.75,112.5,",
          usual + "worst,113,112.75,113.5,",
          usual + "fireflies,114,113.75,114.5,",
          usual + "energy,115,114.75,115.5,",
          usual + "region_energy,116,115.75,116.5,",
          usual + "done,117,116.75,117.5,",
          usual + "missed,118,117.75,118.5,",
          usual + "never_done,119,118.75,119.5,",
          usual + "never_done_cost,120,119.75,120.5,",
          usual + "wasted,121,120.75,121.5,",
          usual + "off_oracle,122,121.75,122.5,",
          usual + "region_spp,123,122.75,123.5,",
          usual + "rejected,124,123.75,124.5,",
          usual + "mean_rays,125,124.75,125.5,",
          usual + "missed_by_audit,130,129.75,130.5,",
          usual + "audited,131,,,",
          usual + "equal_time_error,132,131.75,132.5,",
          usual + "price_of_unbiased,133,,,",
          usual + "cost_spread,134,,,",
          usual + "error_spread,135,,,",
          budget + "verdict,biased,,,",
          budget + "bias,201,200.75,201.5,0.01",
          budget + "region_bias,202,201.75,202.5,0.02",
          budget + "unbiased_bias,203,202.75,203.5,0.03",
          budget + "unbiased_region_bias,204,203.75,204.5,0.04",
          budget + "mean_spp,210,209.75,210.5,",
          budget + "seconds,211,210.75,211.5,",
          budget + "relmse,212,211.75,212.5,",
          budget + "worst,213,212.75,213.5,",
          budget + "fireflies,214,213.75,214.5,",
          budget + "energy,215,214.75,215.5,",
          budget + "region_energy,216,215.75,216.5,",
          budget + "done,217,216.75,217.5,",
          budget + "missed,218,217.75,218.5,",
          budget + "never_done,219,218.75,219.5,",
          budget + "never_done_cost,220,219.75,220.5,",
          budget + "wasted,221,220.75,221.5,",
          budget + "off_oracle,222,221.75,222.5,",
          budget + "region_spp,223,222.75,223.5,",
          budget + "rejected,224,223.75,224.5,",
          budget + "mean_rays,225,224.75,225.5,",
          budget + "missed_by_audit,230,229.75,230.5,",
          budget + "audited,231,,,",
          budget + "equal_time_error,232,231.75,232.5,",
          budget + "price_of_unbiased,233,,,",
          budget + "cost_spread,234,,,",
          budget + "error_spread,235,,,",
          budget + "cost_threshold_up,240,,,",
          budget + "error_threshold_up,241,,,",
          budget + "cost_threshold_down,242,,,",
          budget + "error_threshold_down,243,,,",
          budget + "cost_exposure,244,,,",
          budget + "error_exposure,245,,,",
          budget + "cost_resolution,246,,,",
          budget + "error_resolution,247,,,",
      });
  // 50 pixels, and four times as many at twice the resolution.
  const std::string kl =
      "two-valued,failures/"
      "two-valued,sobol,kl,two-level,unbiased,budget,exposure,0.25,3,6,101.000000,"
      "5750,5000,100.000000,";
  const std::string uniform =
      "two-valued,failures/"
      "two-valued,sobol,uniform,two-level,reuse,default,resolution,,4,7,201.000000,"
      "43000,40000,200.000000,";
  test::expect_lines(
      bytes_of(folder / "trials.csv"),
      {
          ("case,scene,sampler,estimator,policy,mode,tuning,variation,thresholds,seed,pass,"
           "seconds,rays,samples,mean_spp,metric,value"),
          kl + "relmse,102",
          kl + "worst,103",
          kl + "fireflies,104",
          kl + "energy,105",
          kl + "region_energy,106",
          kl + "done,107",
          kl + "never_done,109",
          kl + "never_done_cost,110",
          kl + "wasted,111",
          kl + "off_oracle,112",
          kl + "region_spp,113",
          kl + "rejected,114",
          uniform + "relmse,202",
          uniform + "worst,203",
          uniform + "fireflies,204",
          uniform + "energy,205",
          uniform + "region_energy,206",
          uniform + "done,207",
          uniform + "missed,208",
          uniform + "never_done,209",
          uniform + "never_done_cost,210",
          uniform + "wasted,211",
          uniform + "off_oracle,212",
          uniform + "region_spp,213",
          uniform + "rejected,214",
      });
}

}  // namespace
}  // namespace quartet
