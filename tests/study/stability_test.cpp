#include "renderer/study/stability/stability.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

#include "renderer/study/stability/cell_verdict.h"

namespace quartet {
namespace {

StabilityOptions small(std::initializer_list<const char*> cases,
                       std::vector<EstimatorId> estimators) {
  StabilityOptions options;
  for (const char* id : cases) {
    options.cases.push_back(&find_failure_case(id));
  }
  options.estimators = std::move(estimators);
  options.seeds = 6;
  options.spp = 16.0;
  options.truth.most_spp = 512;
  options.audit_samples = 512;
  return options;
}

std::vector<CaseResult> run(const StabilityOptions& options) {
  return run_stability(options, [](double, std::string_view) {});
}

const Cell& cell_of(const StabilitySummary& summary, std::string_view failure, EstimatorId id,
                    Tuning tuning) {
  return *std::ranges::find_if(summary.cells, [&](const Cell& cell) {
    return cell.failure->id == failure && cell.settings.estimator == id && cell.tuning == tuning;
  });
}

// The whole study in small: the test of bias finds that of reuse, on the two-valued and on the
// rare-light scene, and none in mode unbiased. All tests together raise a false alarm in 1 of 100
// runs of random seeds; these seeds are fixed.
TEST(Stability, FindsTheBiasOfReuseAndNoneInModeUnbiased) {
  const StabilitySummary summary =
      summarize(run(small({"two-valued", "rare-light", "bernoulli"},
                          {EstimatorId::confidence, EstimatorId::rigau_kl})),
                0.01);
  ASSERT_EQ(summary.cells.size(), 12u);
  EXPECT_EQ(summary.confidence.tests, 24.0);
  const double level = summary.confidence.each();
  for (const Cell& cell : summary.cells) {
    EXPECT_GT(cell.unbiased_picture.p, level) << cell.failure->id;
    EXPECT_GT(cell.unbiased_region.p, level) << cell.failure->id;
    EXPECT_TRUE(cell.unbiased_picture.off.contains(0.0)) << cell.failure->id;
  }
  for (const char* failure : {"two-valued", "rare-light", "bernoulli"}) {
    for (const EstimatorId id : {EstimatorId::confidence, EstimatorId::rigau_kl}) {
      const Cell& cell = cell_of(summary, failure, id, Tuning::budget);
      EXPECT_LT(cell.picture.p, level) << failure;
      EXPECT_FALSE(cell.picture.off.contains(0.0)) << failure;
    }
  }
}

// All that a criterion is done with are pixels where eight samples passed beside the wires, because
// the others reach the maximum first.
TEST(Stability, WiresAreMissedByTheFirstSamples) {
  const StabilitySummary summary =
      summarize(run(small({"wires"}, {EstimatorId::confidence})), 0.01);
  const Cell& cell = cell_of(summary, "wires", EstimatorId::confidence, Tuning::usual);
  EXPECT_EQ(cell_verdict(cell).id, "misses");
  EXPECT_GT(cell.value("missed").low, 0.25);
}

TEST(Stability, MeetsTheBudgetWithEveryEstimator) {
  const std::vector<CaseResult> results =
      run(small({"bernoulli"}, {EstimatorId::contrast, EstimatorId::kl, EstimatorId::chi2}));
  for (const Trial& trial : results.front().trials) {
    if (trial.tuning == Tuning::budget && trial.variation == Variation::none &&
        trial.settings.mode == SampleMode::reuse &&
        trial.settings.estimator != EstimatorId::oracle &&
        trial.settings.estimator != EstimatorId::contrast) {
      EXPECT_NEAR(trial.outcome.mean_spp, 16.0, 2.0) << estimator(trial.settings.estimator).id;
    }
  }
}

// With 16 samples everywhere a picture of four times the pixels, shrunk, has a quarter of the
// error. Means over 12 288 squared errors of bernoulli pixels: standard deviation below 2 %.
TEST(Stability, TwiceTheResolutionIsComparedAtTheSameSize) {
  const std::vector<CaseResult> results = run(small({"bernoulli"}, {EstimatorId::cycles}));
  const StabilitySummary summary = summarize(results, 0.01);
  const Cell& cell = cell_of(summary, "bernoulli", EstimatorId::cycles, Tuning::budget);
  const std::optional<Change>& change = cell.changes[std::size_t(Variation::resolution)];
  ASSERT_TRUE(change);
  EXPECT_NEAR(change->cost, 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(change->error, 1.0);
  for (const Trial& trial : results.front().trials) {
    if (trial.variation == Variation::resolution) {
      // Of samples with the variance 0.09, against a mean of 0.1; 2 % off over 6 144 pixels.
      EXPECT_NEAR(trial.outcome.relmse, 0.09 / 64.0 / (0.1 * 0.1 + 0.01), 0.006);
      EXPECT_NEAR(trial.outcome.energy, 0.0, 0.02);
      EXPECT_TRUE(std::isnan(trial.outcome.missed)) << "its pixels are not those of the truth";
    }
  }
}

// On a source of one distribution the share of pixels that are done and wrong is the same in the
// audited ones as in all: the audit sees 1 in 16 of them, over six seeds.
TEST(Stability, TheAuditAgreesWithTheTruth) {
  StabilityOptions options = small({"bernoulli"}, {EstimatorId::chi2});
  options.audit_samples = 8192;
  options.audit_share = 1.0 / 16.0;
  // Means of few samples of 0 or 1 are few numbers; none of them is near this limit.
  options.target = 0.12;
  const StabilitySummary summary = summarize(run(options), 0.01);
  const Cell& cell = cell_of(summary, "bernoulli", EstimatorId::chi2, Tuning::budget);
  EXPECT_GT(cell.audited, 500.0);
  EXPECT_LT(cell.audit.low, cell.value("missed").mean);
  EXPECT_GT(cell.audit.high, cell.value("missed").mean);
  EXPECT_GT(cell.value("missed").mean, 0.25);  // pixels that are all 0 and stay so
}

TEST(Stability, DoesNotDependOnThreads) {
  StabilityOptions options = small({"bernoulli"}, {EstimatorId::kl});
  options.seeds = 2;
  const auto run_on = [&](int threads) {
    std::vector<CaseResult> results;
    tbb::task_arena(threads).execute([&] { results = run(options); });
    return results;
  };
  const std::vector<CaseResult> a = run_on(1);
  const std::vector<CaseResult> b = run_on(4);
  ASSERT_EQ(a.front().trials.size(), b.front().trials.size());
  for (std::size_t i = 0; i < a.front().trials.size(); ++i) {
    const Trial& left = a.front().trials[i];
    const Trial& right = b.front().trials[i];
    EXPECT_EQ(left.settings, right.settings);
    for (const OutcomeColumn& column : outcome_columns()) {
      if (column.id != "seconds") {
        // To the bit, also where there is no number.
        EXPECT_EQ(std::bit_cast<std::uint64_t>(left.outcome.*column.value),
                  std::bit_cast<std::uint64_t>(right.outcome.*column.value))
            << column.id;
      }
    }
  }
}

TEST(Stability, EndsEarlyIfAskedTo) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(run_stability(
                  small({"bernoulli"}, {EstimatorId::kl}), [](double, std::string_view) {},
                  stop.get_token())
                  .empty());
}

/// A cell with nothing wrong.
Cell sound_cell() {
  Cell cell;
  cell.values.assign(outcome_columns().size(), Interval{0.0, 0.0, 0.0});
  cell.equal_time = {0.8, 0.7, 0.9};
  return cell;
}

void set(Cell& cell, std::string_view column, Interval value) {
  const auto columns = outcome_columns();
  const auto place = std::ranges::find(columns, column, &OutcomeColumn::id);
  cell.values[std::size_t(place - columns.begin())] = value;
}

TEST(CellVerdict, IsTheFirstRuleThatHoldsOutsideTheInterval) {
  Cell cell = sound_cell();
  EXPECT_EQ(cell_verdict(cell).id, "sound");
  EXPECT_EQ(cell_verdict(cell).number(cell), "0.8 ×");
  cell.equal_time = {1.3, 1.0, 1.6};
  EXPECT_EQ(cell_verdict(cell).id, "sound");  // it may be by chance
  cell.equal_time = {1.3, 1.2, 1.4};
  EXPECT_EQ(cell_verdict(cell).id, "slow");
  set(cell, "wasted", {0.6, 0.55, 0.65});
  EXPECT_EQ(cell_verdict(cell).id, "wasteful");
  EXPECT_EQ(cell_verdict(cell).number(cell), "60 %");
  set(cell, "never_done", {0.2, 0.1, 0.3});
  EXPECT_EQ(cell_verdict(cell).id, "never-done");
  set(cell, "missed", {0.5, 0.2, 0.8});
  EXPECT_EQ(cell_verdict(cell).id, "never-done");
  set(cell, "missed", {0.5, 0.4, 0.6});
  EXPECT_EQ(cell_verdict(cell).id, "misses");
  cell.region.off = {-0.05, -0.06, -0.04};
  EXPECT_EQ(cell_verdict(cell).number(cell), "−5.0 %");
}

}  // namespace
}  // namespace quartet
