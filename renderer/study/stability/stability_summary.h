#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/base/interval.h"
#include "renderer/study/stability/rule.h"
#include "renderer/study/stability/stability.h"

namespace quartet {

/// How much cost and error change with a variation, as ratios; none if it was not tried.
struct Change {
  double cost = 1.0;  ///< mean samples per pixel
  /// relmse; with twice the resolution that of the shrunk picture, in whose pixels four times the
  /// samples meet, over what becomes of uniform sampling by it.
  double error = 1.0;
};

/// All that the study found of one subject in one case on one kind of terms. Intervals are over
/// seeds, at the confidence of the study.
struct Cell {
  const FailureCase* failure = nullptr;
  Subject subject;  ///< with the settings that its runs had
  Terms terms = Terms::budget;
  std::vector<Finding> findings;  ///< of the rules that apply, in their order
  std::vector<Interval> values;   ///< in the order of outcome_columns()
  std::optional<Finding> twin;    ///< whether what is studied is biased in mode unbiased too
  Interval audit;                 ///< of those done, the share that the audit found wrong
  double audited = 0.0;
  double price = 1.0;        ///< samples of the unbiased twin over its own
  double cost_spread = 0.0;  ///< standard deviation over seeds in relation to the mean
  double error_spread = 0.0;
  std::array<std::optional<Change>, 5> changes;  ///< by Variation

  const Interval& value(std::string_view column) const;
  /// The first that fails, else the first that is open, else that of the last rule.
  const Finding& deciding() const;
};

/// What the numbers of a study may be trusted for.
struct Confidence {
  double family = 0.01;  ///< false-alarm rate of all findings together, those of twins included
  double tests = 1.0;    ///< that there are
  double each() const;   ///< of one, after Šidák
};

struct StabilitySummary {
  Confidence confidence;
  std::vector<Cell> cells;  ///< case by case, terms by terms, subject by subject
};

StabilitySummary summarize(std::span<const CaseResult> results, double family);

}  // namespace quartet
