#include "renderer/study/stability/rule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "renderer/study/stability/outcome.h"

namespace quartet {
namespace {

const Rule& rule_of(std::string_view id) {
  return *std::ranges::find(rules(), id, &Rule::id);
}

// Two runs: Student's t of one degree of freedom is Cauchy's distribution, and the standard error
// half the distance of the two.
TEST(Rule, JudgesByTheWholeInterval) {
  const Rule& rule = rule_of("never-done");
  ASSERT_EQ(rule.limit, 0.05);
  const double p = 0.1;
  const double t = std::tan(0.5 * std::numbers::pi * (1.0 - p));
  const auto judged = [&](double middle, double half) {
    const double off = half / t;
    return judge(rule, std::vector{middle - off, middle + off}, p);
  };
  EXPECT_EQ(judged(0.10, 0.04).verdict, Verdict::fails);
  EXPECT_EQ(judged(0.10, 0.06).verdict, Verdict::open);
  EXPECT_EQ(judged(0.01, 0.06).verdict, Verdict::open);
  EXPECT_EQ(judged(0.01, 0.03).verdict, Verdict::keeps);
  const Finding finding = judged(0.10, 0.04);
  EXPECT_EQ(finding.rule, &rule);
  EXPECT_NEAR(finding.effect.mean, 0.10, 1e-12);
  EXPECT_NEAR(finding.effect.low, 0.06, 1e-9);
  EXPECT_NEAR(finding.effect.high, 0.14, 1e-9);
  // 0.8 of Cauchy's distribution lies below tan(0.3 π).
  EXPECT_NEAR(finding.visible, 0.05 + 0.04 + 0.04 / t * std::tan(0.3 * std::numbers::pi), 1e-9);
}

TEST(Rule, OneThatGoesBothWaysIsBrokenByEither) {
  const Rule& rule = rule_of("biased");
  ASSERT_TRUE(rule.both_ways);
  const auto judged = [&](double effect) { return judge(rule, std::vector{effect, effect}, 0.1); };
  EXPECT_EQ(judged(-0.03).verdict, Verdict::fails);
  EXPECT_EQ(judged(0.03).verdict, Verdict::fails);
  EXPECT_EQ(judged(-0.01).verdict, Verdict::keeps);
  // Of the others less is better.
  EXPECT_EQ(judge(rule_of("misses"), std::vector{-0.9, -0.9}, 0.1).verdict, Verdict::keeps);
}

TEST(Rule, WhatIsNotKnownIsOpen) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& effects : {std::vector{0.9, nan, 0.9}, std::vector{0.9}}) {
    const Finding finding = judge(rule_of("never-done"), effects, 0.1);
    EXPECT_EQ(finding.verdict, Verdict::open);
    EXPECT_TRUE(std::isinf(finding.effect.high));
    EXPECT_TRUE(std::isinf(finding.visible));
  }
}

TEST(Rule, LooksAtItsOwnNumber) {
  Outcome outcome;
  outcome.off = 1.0;
  outcome.too_early = 2.0;
  outcome.never_done = 3.0;
  outcome.over_uniform = std::exp(4.0);
  std::vector<double> effects;
  for (const Rule& rule : rules()) {
    effects.push_back(rule.effect(outcome));
  }
  ASSERT_EQ(effects.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(effects[i], double(i + 1)) << rules()[i].id;
  }
  EXPECT_EQ(rule_of("biased").text(-0.049), "−4.9 %");
  EXPECT_EQ(rule_of("biased").text(0.5), "+50 %");
  EXPECT_EQ(rule_of("never-done").text(0.5), "50 %");
  EXPECT_EQ(rule_of("worse").text(std::log(1.3)), "1.30 ×");
  const Subject kl{"kl", Role::studied, default_settings(EstimatorId::kl)};
  const Subject uniform{"uniform", Role::baseline, default_settings(EstimatorId::uniform)};
  EXPECT_TRUE(rule_of("never-done").applies(kl, Terms::budget));
  EXPECT_FALSE(rule_of("never-done").applies(kl, Terms::window)) << "vote has no end";
  EXPECT_TRUE(rule_of("misses").applies(kl, Terms::window));
  EXPECT_FALSE(rule_of("misses").applies(uniform, Terms::budget)) << "it calls nothing done";
  EXPECT_TRUE(rule_of("worse").applies(uniform, Terms::window));
}

// An effect as large as `visible` says is found 8 times in 10: of 2000 studies of 12 runs 1600 ± 18
// find it. `visible` itself is estimated from the runs, so the true one is put in.
TEST(Rule, WhatIsCalledVisibleIsSeenEightTimesInTen) {
  const Rule& rule = rule_of("never-done");
  constexpr double p = 0.001;
  constexpr int runs = 12;
  constexpr double deviation = 0.02;
  const double error = deviation / std::sqrt(double(runs));
  const double visible =
      rule.limit + error * (student_quantile(p, runs - 1) + student_quantile(0.4, runs - 1));
  std::mt19937 random(11);
  std::normal_distribution<double> noise(visible, deviation);
  int found = 0;
  double told = 0.0;
  for (int study = 0; study < 2000; ++study) {
    std::vector<double> effects(runs);
    std::ranges::generate(effects, [&] { return noise(random); });
    const Finding finding = judge(rule, effects, p);
    found += finding.verdict == Verdict::fails ? 1 : 0;
    told += finding.visible / 2000.0;
  }
  // Known standard errors would make it 0.8; that they are estimated costs some of it.
  EXPECT_GT(found, 1300);
  EXPECT_LT(found, 1690);
  EXPECT_NEAR(told, visible, 0.05 * visible);
}

}  // namespace
}  // namespace quartet
