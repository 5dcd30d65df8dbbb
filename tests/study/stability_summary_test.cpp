#include "renderer/study/stability/stability_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

// Trials made by hand, two seeds each, and every number that is published of them.

namespace quartet {
namespace {

/// Two equal-sided numbers, one a seed: `middle` less and more `off`.
struct Pair {
  double middle;
  double off;
};

/// A trial's numbers: of each column its place in the table and the seed make it what it is.
Outcome numbered_outcome(double first, std::uint64_t seed) {
  Outcome outcome;
  for (std::size_t i = 0; i < outcome_columns().size(); ++i) {
    outcome.*outcome_columns()[i].value = first + double(i) + (seed == 0 ? -0.25 : 0.25);
  }
  return outcome;
}

struct Kind {
  EstimatorId estimator;
  Tuning tuning = Tuning::budget;
  SampleMode mode = SampleMode::reuse;
  Variation variation = Variation::none;
};

/// Adds a trial with each of the seeds 0 and 1, told what is special about it.
template <class Change>
void add_trials(CaseResult& result, const Kind& kind, double first, const Change& change) {
  for (const std::uint64_t seed : {1, 0}) {
    Trial trial;
    trial.failure = result.failure;
    trial.tuning = kind.tuning;
    trial.variation = kind.variation;
    trial.seed = seed;
    trial.settings = default_settings(kind.estimator);
    trial.settings.mode = kind.mode;
    trial.settings.thresholds[0] = kind.tuning == Tuning::usual ? 0.125f : 0.25f;
    trial.outcome = numbered_outcome(first, seed);
    const auto set = [&](double Outcome::*value, Pair pair) {
      trial.outcome.*value = pair.middle + (seed == 0 ? -pair.off : pair.off);
    };
    change(trial.outcome, set);
    result.trials.push_back(trial);
  }
}

void add_trials(CaseResult& result, const Kind& kind, double first) {
  add_trials(result, kind, first, [](Outcome&, const auto&) {});
}

/// What stands beside the estimators.
void add_uniform(CaseResult& result) {
  const Kind uniform{EstimatorId::uniform};
  add_trials(result, {EstimatorId::oracle}, 900.0);
  add_trials(result, uniform, 500.0, [](Outcome& outcome, const auto& set) {
    set(&Outcome::energy, {0.5, 0.0625});
    set(&Outcome::region_energy, {0.25, 0.125});
    set(&Outcome::relmse, {3.0, 1.0});
    set(&Outcome::seconds, {6.0, 2.0});
    outcome.audit = {77.0, 66.0};
  });
  add_trials(result,
             {EstimatorId::uniform, Tuning::budget, SampleMode::reuse, Variation::resolution},
             600.0, [](Outcome&, const auto& set) {
               set(&Outcome::relmse, {1.5, 0.5});
               set(&Outcome::mean_spp, {64.0, 0.0});
             });
}

/// kl, tuned to the budget: all modes and variations.
void add_tuned(CaseResult& result) {
  const auto kl = [](SampleMode mode, Variation variation) {
    return Kind{EstimatorId::kl, Tuning::budget, mode, variation};
  };
  add_trials(result, kl(SampleMode::reuse, Variation::none), 100.0,
             [](Outcome& outcome, const auto& set) {
               set(&Outcome::mean_spp, {16.0, 4.0});
               set(&Outcome::seconds, {3.0, 1.0});
               set(&Outcome::relmse, {10.0, 6.0});
               set(&Outcome::energy, {0.625, 0.03125});
               set(&Outcome::region_energy, {-0.5, 0.25});
               outcome.audit = {20.0, 5.0};
             });
  add_trials(result, kl(SampleMode::unbiased, Variation::none), 200.0,
             [](Outcome& outcome, const auto& set) {
               set(&Outcome::seconds, {7.5, 2.5});
               set(&Outcome::energy, {0.75, 0.25});
               set(&Outcome::region_energy, {0.375, 0.0});
               outcome.audit = {90.0, 80.0};
             });
  double first = 210.0;
  for (const auto& [variation, cost, error] :
       {std::tuple{Variation::threshold_up, Pair{12.0, 2.0}, Pair{15.0, 1.0}},
        {Variation::threshold_down, Pair{20.0, 2.0}, Pair{8.0, 3.0}},
        {Variation::exposure, Pair{24.0, 8.0}, Pair{40.0, 0.0}},
        {Variation::resolution, Pair{8.0, 1.0}, Pair{1.25, 0.25}}}) {
    add_trials(result, kl(SampleMode::reuse, variation), first += 10.0,
               [&, cost = cost, error = error](Outcome&, const auto& set) {
                 set(&Outcome::mean_spp, cost);
                 set(&Outcome::relmse, error);
               });
  }
}

CaseResult case_of(const char* id, std::uint64_t truth_spp) {
  CaseResult result;
  result.failure = &find_failure_case(id);
  result.truth.spp = truth_spp;
  // First of all an estimator's own, out of order as they may come.
  add_trials(result, {EstimatorId::kl, Tuning::usual}, 300.0);
  add_trials(result, {EstimatorId::kl, Tuning::usual, SampleMode::unbiased}, 400.0);
  add_uniform(result);
  add_tuned(result);
  return result;
}

constexpr double family = 0.5;
// Two cases, one estimator, two tunings; picture and region of each.
const double rate = 1.0 - std::pow(1.0 - family, 1.0 / 8.0);
// Student's t of one degree of freedom is Cauchy's distribution.
const double cauchy = std::tan(0.5 * std::numbers::pi * (1.0 - rate));

/// Of two numbers the standard error of the mean is half their distance.
void expect_interval(const Interval& interval, Pair pair) {
  EXPECT_NEAR(interval.mean, pair.middle, 1e-9);
  EXPECT_NEAR(interval.low, pair.middle - cauchy * std::abs(pair.off), 1e-6);
  EXPECT_NEAR(interval.high, pair.middle + cauchy * std::abs(pair.off), 1e-6);
}

void expect_bias(const BiasTest& test, Pair pair) {
  expect_interval(test.off, pair);
  const double t = pair.middle / pair.off;
  EXPECT_NEAR(test.p, 1.0 - 2.0 / std::numbers::pi * std::atan(std::abs(t)), 1e-9);
}

const StabilitySummary& summary() {
  static const StabilitySummary made = summarize(
      std::vector<CaseResult>{case_of("two-valued", 0), case_of("rare-light", 512)}, family);
  return made;
}

TEST(StabilitySummary, HasACellOfEachCaseEstimatorAndTuning) {
  ASSERT_EQ(summary().cells.size(), 4u) << "of uniform and oracle none";
  EXPECT_EQ(summary().confidence.family, family);
  EXPECT_EQ(summary().confidence.tests, 8.0);
  EXPECT_NEAR(summary().confidence.each(), rate, 1e-12);
  for (std::size_t i = 0; i < 4; ++i) {
    const Cell& cell = summary().cells[i];
    EXPECT_EQ(cell.failure->id, i < 2 ? "two-valued" : "rare-light");
    EXPECT_EQ(cell.tuning, i % 2 == 0 ? Tuning::usual : Tuning::budget);
    EXPECT_EQ(cell.settings.estimator, EstimatorId::kl);
    EXPECT_EQ(cell.settings.mode, SampleMode::reuse);
    EXPECT_EQ(cell.settings.thresholds[0], i % 2 == 0 ? 0.125f : 0.25f);
  }
  EXPECT_TRUE(summarize({}, family).cells.empty());
}

TEST(StabilitySummary, ValuesAreThoseOfTheirColumnsInModeReuse) {
  const auto expect_column = [](std::string_view id, Pair usual, Pair budget) {
    SCOPED_TRACE(id);
    expect_interval(summary().cells[0].value(id), usual);
    expect_interval(summary().cells[1].value(id), budget);
  };
  ASSERT_EQ(outcome_columns().size(), 16u);
  expect_column("mean_spp", {300, 0.25}, {16, 4});
  expect_column("seconds", {301, 0.25}, {3, 1});
  expect_column("relmse", {302, 0.25}, {10, 6});
  expect_column("worst", {303, 0.25}, {103, 0.25});
  expect_column("fireflies", {304, 0.25}, {104, 0.25});
  expect_column("energy", {305, 0.25}, {0.625, 0.03125});
  expect_column("region_energy", {306, 0.25}, {-0.5, 0.25});
  expect_column("done", {307, 0.25}, {107, 0.25});
  expect_column("missed", {308, 0.25}, {108, 0.25});
  expect_column("never_done", {309, 0.25}, {109, 0.25});
  expect_column("never_done_cost", {310, 0.25}, {110, 0.25});
  expect_column("wasted", {311, 0.25}, {111, 0.25});
  expect_column("off_oracle", {312, 0.25}, {112, 0.25});
  expect_column("region_spp", {313, 0.25}, {113, 0.25});
  expect_column("rejected", {314, 0.25}, {114, 0.25});
  expect_column("mean_rays", {315, 0.25}, {115, 0.25});
}

TEST(StabilitySummary, BiasIsThatOfPictureAndRegionInEachMode) {
  // Against an exact truth: the energies as they are.
  const Cell& exact = summary().cells[1];
  expect_bias(exact.picture, {0.625, 0.03125});
  expect_bias(exact.region, {-0.5, 0.25});
  expect_bias(exact.unbiased_picture, {0.75, 0.25});
  expect_interval(exact.unbiased_region.off, {0.375, 0.0});
  EXPECT_EQ(exact.unbiased_region.p, 0.0) << "both seeds say the same";
  // Against a rendered one: less those of uniform sampling, seed by seed.
  const Cell& rendered = summary().cells[3];
  expect_bias(rendered.picture, {0.125, -0.03125});
  expect_bias(rendered.region, {-0.75, 0.125});
  expect_bias(rendered.unbiased_picture, {0.25, 0.1875});
  expect_bias(rendered.unbiased_region, {0.125, -0.125});
}

TEST(StabilitySummary, EqualTimeIsErrorTimesTimeOverThatOfUniformSampling) {
  // Seed 0: 4 · 2 / (2 · 4) = 1; seed 1: 16 · 4 / (4 · 8) = 2.
  const Interval& ratio = summary().cells[1].equal_time;
  const double root = std::sqrt(2.0);
  EXPECT_NEAR(ratio.mean, root, 1e-9);
  EXPECT_NEAR(std::log(ratio.low), std::log(root) - cauchy * std::log(root), 1e-6);
  EXPECT_NEAR(std::log(ratio.high), std::log(root) + cauchy * std::log(root), 1e-6);
}

TEST(StabilitySummary, EqualTimeOfNoErrorIsNotKnown) {
  CaseResult result = case_of("two-valued", 0);
  for (Trial& trial : result.trials) {
    trial.outcome.relmse = trial.settings.estimator == EstimatorId::kl ? 0.0 : trial.outcome.relmse;
  }
  const Interval ratio = summarize(std::span(&result, 1), family).cells[1].equal_time;
  EXPECT_EQ(ratio.mean, 1.0);
  EXPECT_EQ(ratio.low, 0.0);
  EXPECT_TRUE(std::isinf(ratio.high));
}

TEST(StabilitySummary, TheRestIsRatiosOfMeansAndSpreads) {
  const Cell& cell = summary().cells[1];
  EXPECT_DOUBLE_EQ(cell.price, 2.5) << "7.5 s over 3 s";
  EXPECT_NEAR(cell.cost_spread, std::sqrt(32.0) / 16.0, 1e-12) << "of 12 and 20";
  EXPECT_NEAR(cell.error_spread, std::sqrt(72.0) / 10.0, 1e-12) << "of 4 and 16";
  EXPECT_DOUBLE_EQ(summary().cells[0].price, 401.0 / 301.0);
  // 10 of 40 that are done, by Wilson's formula.
  EXPECT_EQ(cell.audited, 40.0);
  EXPECT_EQ(cell.audit.mean, 0.25);
  const Interval wilson = share_interval(10.0, 40.0, rate);
  EXPECT_DOUBLE_EQ(cell.audit.low, wilson.low);
  EXPECT_DOUBLE_EQ(cell.audit.high, wilson.high);
}

TEST(StabilitySummary, ChangesAreAgainstThePlainExperimentWithTheSameSeeds) {
  const auto expect_change = [](Variation variation, double cost, double error) {
    SCOPED_TRACE(variations()[std::size_t(variation)].id);
    const auto& change = summary().cells[1].changes[std::size_t(variation)];
    ASSERT_TRUE(change);
    EXPECT_DOUBLE_EQ(change->cost, cost);
    EXPECT_DOUBLE_EQ(change->error, error);
    EXPECT_FALSE(summary().cells[0].changes[std::size_t(variation)]) << "was not tried";
  };
  expect_change(Variation::threshold_up, 12.0 / 16.0, 1.5);
  expect_change(Variation::threshold_down, 20.0 / 16.0, 0.8);
  expect_change(Variation::exposure, 24.0 / 16.0, 4.0);
  // Uniform sampling's own error is halved by the resolution.
  expect_change(Variation::resolution, 8.0 / 16.0, 1.25 / 10.0 / 0.5);
  EXPECT_FALSE(summary().cells[1].changes[std::size_t(Variation::none)]);
}

TEST(StabilitySummary, AChangeTriedWithFewerSeedsIsAgainstThoseSeeds) {
  CaseResult result = case_of("two-valued", 0);
  std::erase_if(result.trials, [](const Trial& trial) {
    return trial.variation == Variation::threshold_up && trial.seed == 1;
  });
  const StabilitySummary few = summarize(std::span(&result, 1), family);
  const auto& change = few.cells[1].changes[std::size_t(Variation::threshold_up)];
  EXPECT_DOUBLE_EQ(change->cost, 10.0 / 12.0);
  EXPECT_DOUBLE_EQ(change->error, 14.0 / 4.0);
}

}  // namespace
}  // namespace quartet
