#include "renderer/study/threshold_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace quartet {
namespace {

/// A lane whose runs change between factors 1/1000 and 1000, and take the fewer samples the higher
/// the factor is. `quality` is of log2 of the factor.
class PlannedLane {
 public:
  explicit PlannedLane(std::function<double(double)> quality) : quality_(std::move(quality)) {}

  ThresholdScan scan() {
    return *scan_thresholds([this](double factor) { return std::optional(run(factor)); });
  }
  ScannedRun run(double factor) {
    ++runs_;
    const double kept = std::clamp(factor, 1e-3, 1e3);
    return {factor, quality_(std::log2(kept)), 100.0 / kept};
  }
  int runs() const { return runs_; }

 private:
  std::function<double(double)> quality_;
  int runs_ = 0;
};

TEST(ThresholdScan, AnErrorThatRisesWithTheThresholdIsMetNearly) {
  PlannedLane lane([](double log) { return std::exp2(3.3 - log); });
  const ThresholdScan scan = lane.scan();
  EXPECT_TRUE(scan.best.met());
  EXPECT_FALSE(scan.always);
  EXPECT_NEAR(std::log2(scan.best.factor), 3.3, 0.002);
  EXPECT_LT(lane.runs(), 45);
  EXPECT_EQ(int(scan.runs.size()), lane.runs());
  EXPECT_TRUE(std::ranges::is_sorted(scan.runs, {}, &ScannedRun::factor));
}

TEST(ThresholdScan, OfSeveralCrossingsTheCheapestIsTaken) {
  // Met below 2^-5.2, and in an island from 2^1.4 to 2^3.7.
  PlannedLane lane([](double log) {
    return log < 0.0 ? std::exp2(-5.2 - log) : std::exp2(0.5 * (1.15 - std::abs(log - 2.55)));
  });
  const ThresholdScan scan = lane.scan();
  EXPECT_NEAR(std::log2(scan.best.factor), 3.7, 0.004);
  EXPECT_LT(lane.runs(), 60);
}

TEST(ThresholdScan, WhereOnlyTheHighestMeetItTheRunsAreNotSpentOnDearerOnes) {
  // Better the less is done, as where late samples hold light that the truth has not.
  PlannedLane lane([](double log) { return std::exp2(log - 4.3); });
  const ThresholdScan scan = lane.scan();
  EXPECT_TRUE(scan.best.met());
  EXPECT_EQ(scan.best.cost, 0.1);
  EXPECT_EQ(scan.best.factor, 1024.0) << "of all with nothing to do, the nearest to 1";
  EXPECT_LT(lane.runs(), 27);
}

TEST(ThresholdScan, AlwaysBetterIsMetByTheCheapest) {
  PlannedLane lane([](double log) { return 3.0 + 0.01 * log; });
  const ThresholdScan scan = lane.scan();
  EXPECT_TRUE(scan.always);
  EXPECT_EQ(scan.best.cost, 0.1);
  EXPECT_EQ(scan.best.factor, 1024.0);
}

TEST(ThresholdScan, AnIslandBetweenTwoStepsIsFoundFromItsShores) {
  // Met from 2^2.35 to 2^2.65 only, between the steps 2^2 and 2^3.
  PlannedLane lane([](double log) { return std::exp2(0.15 - std::abs(log - 2.5)); });
  const ThresholdScan scan = lane.scan();
  EXPECT_TRUE(scan.best.met());
  EXPECT_NEAR(std::log2(scan.best.factor), 2.65, 0.002);
}

TEST(ThresholdScan, WhatNoneMeetsIsTheNearest) {
  PlannedLane lane([](double log) { return 0.9 * std::exp2(-std::abs(log + 3.3)); });
  const ThresholdScan scan = lane.scan();
  EXPECT_FALSE(scan.best.met());
  EXPECT_FALSE(scan.always);
  EXPECT_NEAR(std::log2(scan.best.factor), -3.3, 0.03);
  EXPECT_LT(lane.runs(), 45);
}

TEST(ThresholdScan, ALaneThatNoThresholdChangesTakesThreeRuns) {
  int runs = 0;
  const auto scan = scan_thresholds([&](double factor) {
    ++runs;
    return std::optional(ScannedRun{factor, 2.0, 5.0});
  });
  EXPECT_EQ(scan->best.factor, 1.0);
  EXPECT_EQ(runs, 3);
}

TEST(ThresholdScan, EndsWithTheRunThatIsStopped) {
  for (int last = 0; last < 30; ++last) {
    int runs = 0;
    PlannedLane lane([](double log) { return std::exp2(3.3 - log); });
    const auto scan = scan_thresholds([&](double factor) {
      return runs++ == last ? std::nullopt : std::optional(lane.run(factor));
    });
    EXPECT_FALSE(scan);
    EXPECT_EQ(runs, last + 1);
  }
}

}  // namespace
}  // namespace quartet
