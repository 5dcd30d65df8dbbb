#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/base/interval.h"
#include "renderer/study/stability/stability.h"

namespace quartet {

/// A test of whether a mean over seeds is off from what it should be.
struct BiasTest {
  Interval off;    ///< relative to the true energy
  double p = 1.0;  ///< that it would be as far off if it was right, before any correction
};

/// How much cost and error change with a variation, as ratios; none if it was not tried.
struct Change {
  double cost = 1.0;  ///< mean samples per pixel
  /// relmse; with twice the resolution that of the shrunk picture, in whose pixels four times the
  /// samples meet, over what becomes of uniform sampling by it.
  double error = 1.0;
};

/// All that the study found of one estimator in one case with one tuning. Intervals are over seeds,
/// at the confidence of the study.
struct Cell {
  const FailureCase* failure = nullptr;
  Tuning tuning{};
  LaneSettings settings;         ///< in mode reuse
  std::vector<Interval> values;  ///< in mode reuse, in the order of outcome_columns()
  BiasTest picture, region;      ///< in mode reuse
  BiasTest unbiased_picture, unbiased_region;
  Interval audit;  ///< of those done, the share that the audit found wrong
  double audited = 0.0;
  Interval equal_time;       ///< error in relation to uniform sampling of the same time
  double price = 1.0;        ///< seconds of mode unbiased over those of reuse
  double cost_spread = 0.0;  ///< standard deviation over seeds in relation to the mean
  double error_spread = 0.0;
  std::array<std::optional<Change>, 5> changes;  ///< by Variation

  const Interval& value(std::string_view column) const;
};

/// What the numbers of a study may be trusted for.
struct Confidence {
  double family = 0.01;  ///< false-alarm rate of all intervals and tests of one kind together
  double tests = 1.0;    ///< that there are of the kind
  double each() const;   ///< of one test, after Šidák
};

struct StabilitySummary {
  Confidence confidence;
  std::vector<Cell> cells;  ///< case by case, estimator by estimator, tuning by tuning
};

StabilitySummary summarize(std::span<const CaseResult> results, double family);

}  // namespace quartet
