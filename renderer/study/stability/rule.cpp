#include "renderer/study/stability/rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/study/stability/outcome.h"

namespace quartet {
namespace {

std::string signed_percent(double share) {
  const double percent = 100.0 * share;
  return fmt::format("{}{:.{}f} %", percent < 0.0 ? "−" : "+", std::abs(percent),
                     std::abs(percent) < 9.95 ? 1 : 0);
}

std::string percent(double share) {
  return fmt::format("{:.0f} %", 100.0 * share);
}

/// Of the logarithm of a ratio.
std::string times(double log_ratio) {
  const double ratio = std::exp(log_ratio);
  return ratio < 99.5 ? fmt::format("{:.{}f} ×", ratio, ratio < 9.95 ? 2 : 0) : "> 99 ×";
}

bool always(const Subject& /*subject*/, Terms /*terms*/) {
  return true;
}

/// Without an error nothing is ever called done.
bool where_it_is_done(const Subject& subject, Terms /*terms*/) {
  return estimator(subject.settings.estimator).channels > 0;
}

/// Under vote no pixel is at a maximum.
bool where_it_ends(const Subject& subject, Terms terms) {
  return where_it_is_done(subject, terms) && terms == Terms::budget;
}

const std::array rule_table{
    Rule{"biased",
         "biased",
         "The region's mean is off by more than 2 %.",
         {178, 24, 43},
         [](const Outcome& outcome) { return outcome.off; },
         0.02,
         true,
         signed_percent,
         always},
    Rule{
        "misses",
        "stops too early",
        "Of the region's pixels that it is done with, more than 5 % have so few samples that their "
        "expected error is over twice what an oracle leaves.",
        {225, 87, 40},
        [](const Outcome& outcome) { return outcome.too_early; },
        0.05,
        false,
        percent,
        where_it_is_done},
    Rule{"never-done",
         "never done",
         "More than 5 % of the region's pixels are at the maximum, where an oracle has long been "
         "done.",
         {136, 65, 157},
         [](const Outcome& outcome) { return outcome.never_done; },
         0.05,
         false,
         percent,
         where_it_ends},
    Rule{"worse",
         "worse than uniform",
         "Its relMSE of regions is more than 1.1 × that of as many uniform samples.",
         {148, 110, 20},
         [](const Outcome& outcome) { return std::log(outcome.over_uniform); },
         std::log(1.1),
         false,
         times,
         always},
};

}  // namespace

std::span<const Rule> rules() {
  return rule_table;
}

std::string_view verdict_id(Verdict verdict) {
  switch (verdict) {
    case Verdict::keeps:
      return "keeps";
    case Verdict::open:
      return "open";
    case Verdict::fails:
      return "fails";
  }
  return "";
}

Finding judge(const Rule& rule, std::span<const double> effects, double p) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Finding finding{&rule, {mean_of(effects), -infinity, infinity}, infinity, Verdict::open};
  if (effects.size() < 2 ||
      std::ranges::any_of(effects, [](double effect) { return !std::isfinite(effect); })) {
    return finding;
  }
  finding.effect = mean_interval(effects, p);
  const double half = finding.effect.high - finding.effect.mean;
  const int freedom = int(effects.size()) - 1;
  constexpr double missed = 0.2;
  // One-sided, so twice the probability.
  const double further = student_quantile(2.0 * missed, freedom) / student_quantile(p, freedom);
  finding.visible = rule.limit + half * (1.0 + further);
  const Interval& effect = finding.effect;
  const double least = rule.both_ways ? -rule.limit : -infinity;
  if (effect.low > rule.limit || effect.high < least) {
    finding.verdict = Verdict::fails;
  } else if (effect.high <= rule.limit && effect.low >= least) {
    finding.verdict = Verdict::keeps;
  }
  return finding;
}

}  // namespace quartet
