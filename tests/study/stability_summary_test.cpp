#include "renderer/study/stability/stability_summary.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

// Trials made by hand, two seeds each, and every number that is published of them.

namespace quartet {
namespace {

/// Two numbers, one a seed: `middle` less and more `off`.
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

struct TrialKind {
  std::string_view subject;
  EstimatorId estimator;
  Terms terms = Terms::budget;
  SampleMode mode = SampleMode::reuse;
  Variation variation = Variation::none;
};

/// Adds a trial with each of the seeds 0 and 1, out of order as they may come; `change` is told
/// what is special about it.
template <class Change>
void add_trials(CaseResult& result, const TrialKind& kind, double first, const Change& change) {
  for (const std::uint64_t seed : {1, 0}) {
    Trial trial;
    trial.failure = result.failure;
    trial.subject = kind.subject;
    trial.terms = kind.terms;
    trial.variation = kind.variation;
    trial.seed = seed;
    trial.settings = default_settings(kind.estimator);
    trial.settings.mode = kind.mode;
    trial.settings.thresholds[0] = kind.terms == Terms::window ? 0.125f : 0.25f;
    trial.outcome = numbered_outcome(first, seed);
    const auto set = [&](double Outcome::*value, Pair pair) {
      trial.outcome.*value = pair.middle + (seed == 0 ? -pair.off : pair.off);
    };
    change(trial.outcome, set);
    result.trials.push_back(trial);
  }
}

void add_trials(CaseResult& result, const TrialKind& kind, double first) {
  add_trials(result, kind, first, [](Outcome&, const auto&) {});
}

void add_varied(CaseResult& result) {
  double first = 210.0;
  for (const auto& [variation, cost, error] :
       {std::tuple{Variation::threshold_up, Pair{12.0, 2.0}, Pair{15.0, 1.0}},
        {Variation::threshold_down, Pair{20.0, 2.0}, Pair{8.0, 3.0}},
        {Variation::exposure, Pair{24.0, 8.0}, Pair{40.0, 0.0}},
        {Variation::resolution, Pair{8.0, 1.0}, Pair{1.25, 0.25}}}) {
    add_trials(result, {.subject = "kl", .estimator = EstimatorId::kl, .variation = variation},
               first += 10.0, [&, cost = cost, error = error](Outcome&, const auto& set) {
                 set(&Outcome::mean_spp, cost);
                 set(&Outcome::relmse, error);
               });
  }
  add_trials(
      result,
      {.subject = "uniform", .estimator = EstimatorId::uniform, .variation = Variation::resolution},
      600.0, [](Outcome&, const auto& set) {
        set(&Outcome::relmse, {1.5, 0.5});
      });
}

/// uniform and kl on both terms, and a planted mistake on those of the budget.
CaseResult made_case(const char* id) {
  CaseResult result;
  result.failure = &find_failure_case(id);
  result.subjects = {{"uniform", Role::baseline, default_settings(EstimatorId::uniform)},
                     {"kl", Role::studied, default_settings(EstimatorId::kl)},
                     {"lucky", Role::planted, default_settings(EstimatorId::half_buffer)}};
  add_trials(result, {.subject = "kl", .estimator = EstimatorId::kl, .terms = Terms::window},
             300.0);
  add_trials(result,
             {.subject = "uniform", .estimator = EstimatorId::uniform, .terms = Terms::window},
             800.0);
  add_trials(result, {.subject = "uniform", .estimator = EstimatorId::uniform}, 500.0,
             [](Outcome&, const auto& set) {
               set(&Outcome::relmse, {3.0, 1.0});
             });
  add_trials(result, {.subject = "lucky", .estimator = EstimatorId::half_buffer}, 700.0);
  add_trials(result, {.subject = "kl", .estimator = EstimatorId::kl}, 100.0,
             [](Outcome& outcome, const auto& set) {
               set(&Outcome::mean_spp, {16.0, 4.0});
               set(&Outcome::relmse, {10.0, 6.0});
               set(&Outcome::off, {-0.5, 0.25});
               set(&Outcome::too_early, {0.5, 0.125});
               set(&Outcome::never_done, {0.75, 0.0625});
               outcome.over_uniform = outcome.mean_spp < 16.0 ? 2.0 : 8.0;
               outcome.audit = {{7, true}, {9, false}};
             });
  add_trials(result, {.subject = "kl", .estimator = EstimatorId::kl, .mode = SampleMode::unbiased},
             200.0, [](Outcome& outcome, const auto& set) {
               set(&Outcome::mean_spp, {40.0, 1.0});
               set(&Outcome::off, {0.375, 0.25});
               outcome.audit = {{1, true}, {2, true}};
             });
  add_varied(result);
  return result;
}

constexpr double family = 0.5;
// A case: uniform by two rules, kl and the mistake by four, the twin of kl, and under vote uniform
// by two and kl by three.
constexpr double tests_of_a_case = 2 + 4 + 4 + 1 + 2 + 3;
const double rate = 1.0 - std::pow(1.0 - family, 1.0 / (2.0 * tests_of_a_case));
// Student's t of one degree of freedom is Cauchy's distribution.
const double cauchy = std::tan(0.5 * std::numbers::pi * (1.0 - rate));

/// Of two numbers the standard error of the mean is half their distance.
void expect_interval(const Interval& interval, Pair pair) {
  EXPECT_NEAR(interval.mean, pair.middle, 1e-9);
  EXPECT_NEAR(interval.low, pair.middle - cauchy * std::abs(pair.off), 1e-5);
  EXPECT_NEAR(interval.high, pair.middle + cauchy * std::abs(pair.off), 1e-5);
}

const StabilitySummary& summary() {
  static const StabilitySummary made =
      summarize(std::vector<CaseResult>{made_case("two-valued"), made_case("rare-light")}, family);
  return made;
}

const Cell& made_cell(std::string_view subject, Terms terms) {
  return *std::ranges::find_if(summary().cells, [&](const Cell& cell) {
    return cell.subject.id == subject && cell.terms == terms;
  });
}

TEST(StabilitySummary, HasACellOfEachCaseTermsAndSubjectThatWasRun) {
  std::vector<std::string> cells;
  for (const Cell& cell : summary().cells) {
    cells.push_back(
        fmt::format("{} {} {}", cell.failure->id, terms_row(cell.terms).id, cell.subject.id));
    EXPECT_EQ(cell.subject.settings.mode, SampleMode::reuse);
    EXPECT_EQ(cell.subject.settings.thresholds[0], cell.terms == Terms::window ? 0.125f : 0.25f);
  }
  EXPECT_EQ(cells, (std::vector<std::string>{"two-valued budget uniform", "two-valued budget kl",
                                             "two-valued budget lucky", "two-valued window uniform",
                                             "two-valued window kl", "rare-light budget uniform",
                                             "rare-light budget kl", "rare-light budget lucky",
                                             "rare-light window uniform", "rare-light window kl"}));
  EXPECT_TRUE(summarize({}, family).cells.empty());
}

TEST(StabilitySummary, AllFindingsAreOneFamily) {
  EXPECT_EQ(summary().confidence.family, family);
  EXPECT_EQ(summary().confidence.tests, 2.0 * tests_of_a_case);
  EXPECT_NEAR(summary().confidence.each(), rate, 1e-12);
}

TEST(StabilitySummary, FindingsAreOfTheRulesThatApplyToTheTerms) {
  const Cell& budget = made_cell("kl", Terms::budget);
  ASSERT_EQ(budget.findings.size(), 4u);
  expect_interval(budget.findings[0].effect, {-0.5, 0.25});
  expect_interval(budget.findings[1].effect, {0.5, 0.125});
  expect_interval(budget.findings[2].effect, {0.75, 0.0625});
  expect_interval(budget.findings[3].effect, {std::log(4.0), std::log(2.0)});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(budget.findings[i].rule, &rules()[i]);
  }
  const Cell& window = made_cell("kl", Terms::window);
  ASSERT_EQ(window.findings.size(), 3u) << "under vote nothing is ever done";
  EXPECT_EQ(window.findings[2].rule->id, "worse");
  EXPECT_FALSE(window.twin);
}

TEST(StabilitySummary, WhatIsStudiedHasATwin) {
  const Cell& cell = made_cell("kl", Terms::budget);
  ASSERT_TRUE(cell.twin);
  EXPECT_EQ(cell.twin->rule->id, "biased");
  expect_interval(cell.twin->effect, {0.375, 0.25});
  EXPECT_DOUBLE_EQ(cell.price, 2.5) << "40 samples over 16";
  EXPECT_FALSE(made_cell("uniform", Terms::budget).twin);
  EXPECT_FALSE(made_cell("lucky", Terms::budget).twin);
}

TEST(StabilitySummary, TheFirstThatFailsDecidesElseTheFirstThatIsOpen) {
  Cell cell;
  for (const Rule& rule : rules()) {
    cell.findings.push_back(
        {.rule = &rule, .effect = {}, .visible = 0.0, .verdict = Verdict::keeps});
  }
  EXPECT_EQ(cell.deciding().rule->id, "worse");
  EXPECT_EQ(cell.deciding().verdict, Verdict::keeps);
  cell.findings[1].verdict = Verdict::open;
  EXPECT_EQ(cell.deciding().rule->id, "misses");
  cell.findings[2].verdict = Verdict::fails;
  cell.findings[3].verdict = Verdict::fails;
  EXPECT_EQ(cell.deciding().rule->id, "never-done");
}

TEST(StabilitySummary, ValuesAreThoseOfTheirColumnsInModeReuse) {
  ASSERT_EQ(outcome_columns().size(), 21u);
  for (std::size_t i = 0; i < outcome_columns().size(); ++i) {
    const std::string_view id = outcome_columns()[i].id;
    SCOPED_TRACE(id);
    expect_interval(made_cell("kl", Terms::window).value(id), {300.0 + double(i), 0.25});
    expect_interval(made_cell("lucky", Terms::budget).value(id), {700.0 + double(i), 0.25});
  }
  expect_interval(made_cell("kl", Terms::budget).value("mean_spp"), {16.0, 4.0});
  expect_interval(made_cell("kl", Terms::budget).value("off"), {-0.5, 0.25});
}

TEST(StabilitySummary, TheRestIsSharesAndSpreads) {
  const Cell& cell = made_cell("kl", Terms::budget);
  EXPECT_NEAR(cell.cost_spread, std::sqrt(32.0) / 16.0, 1e-12) << "of 12 and 20";
  EXPECT_NEAR(cell.error_spread, std::sqrt(72.0) / 10.0, 1e-12) << "of 4 and 16";
  // Two pixels, seen by both seeds: one of them wrong.
  EXPECT_EQ(cell.audited, 4.0);
  const std::vector<Audit::Look> looks{{7, true}, {9, false}, {7, true}, {9, false}};
  const Interval expected = wrong_share_interval(looks, rate);
  EXPECT_EQ(cell.audit.mean, 0.5);
  EXPECT_DOUBLE_EQ(cell.audit.low, expected.low);
  EXPECT_DOUBLE_EQ(cell.audit.high, expected.high);
}

TEST(StabilitySummary, ChangesAreAgainstThePlainExperimentWithTheSameSeeds) {
  const auto expect_change = [](Variation variation, double cost, double error) {
    SCOPED_TRACE(variations()[std::size_t(variation)].id);
    const auto& change = made_cell("kl", Terms::budget).changes[std::size_t(variation)];
    ASSERT_TRUE(change);
    EXPECT_DOUBLE_EQ(change->cost, cost);
    EXPECT_DOUBLE_EQ(change->error, error);
    EXPECT_FALSE(made_cell("kl", Terms::window).changes[std::size_t(variation)]);
  };
  expect_change(Variation::threshold_up, 12.0 / 16.0, 1.5);
  expect_change(Variation::threshold_down, 20.0 / 16.0, 0.8);
  expect_change(Variation::exposure, 24.0 / 16.0, 4.0);
  // Uniform sampling's own error is halved by the resolution.
  expect_change(Variation::resolution, 8.0 / 16.0, 1.25 / 10.0 / 0.5);
  EXPECT_FALSE(made_cell("kl", Terms::budget).changes[std::size_t(Variation::none)]);
}

TEST(StabilitySummary, AChangeTriedWithFewerSeedsIsAgainstThoseSeeds) {
  CaseResult result = made_case("two-valued");
  std::erase_if(result.trials, [](const Trial& trial) {
    return trial.variation == Variation::threshold_up && trial.seed == 1;
  });
  const StabilitySummary few = summarize(std::span(&result, 1), family);
  const auto cell = std::ranges::find_if(few.cells, [](const Cell& candidate) {
    return candidate.subject.id == "kl" && candidate.terms == Terms::budget;
  });
  const auto& change = cell->changes[std::size_t(Variation::threshold_up)];
  EXPECT_DOUBLE_EQ(change->cost, 10.0 / 12.0);
  EXPECT_DOUBLE_EQ(change->error, 14.0 / 4.0);
}

}  // namespace
}  // namespace quartet
