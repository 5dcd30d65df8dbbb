#pragma once

#include <span>
#include <string>
#include <string_view>

#include "renderer/base/image.h"
#include "renderer/base/interval.h"
#include "renderer/study/stability/subject.h"

namespace quartet {

struct Outcome;

/// One row of the table of rules, the worst failure first. Each is one that an oracle keeps and
/// that a planted mistake breaks; see planted_mistakes().
struct Rule {
  std::string_view id;
  std::string_view label;
  std::string_view sentence;  ///< what breaks it
  Rgba8 color;
  double (*effect)(const Outcome& outcome);  ///< of one run; more is worse
  double limit;                              ///< of the effect
  bool both_ways = false;                    ///< less than −limit is as bad
  std::string (*text)(double effect);        ///< short
  bool (*applies)(const Subject& subject, Terms terms);
};

std::span<const Rule> rules();

enum class Verdict {
  keeps,  ///< the whole interval is within the limits
  open,   ///< it may be either
  fails,  ///< the whole interval is beyond a limit
};
std::string_view verdict_id(Verdict verdict);

/// What a rule says of some runs.
struct Finding {
  const Rule* rule = nullptr;
  Interval effect;
  /// The smallest effect beyond the limit that would have been found with a probability of 0.8.
  double visible = 0.0;
  Verdict verdict = Verdict::open;
};

/// `effects` are those of independent runs; the interval is two-sided at confidence 1 − p. One that
/// is NaN leaves everything open.
Finding judge(const Rule& rule, std::span<const double> effects, double p);

}  // namespace quartet
