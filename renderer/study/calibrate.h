#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

#include "renderer/measure/capped.h"
#include "renderer/study/experiment.h"

namespace quartet {

/// What every estimator is given, or has to reach, within a number of passes: exactly one of mean
/// samples a pixel, as-if-alone seconds, and an error.
struct CommonBudget {
  std::uint32_t passes = 15;
  std::optional<double> spp = {};
  std::optional<double> seconds = {};
  std::optional<ErrorTarget> error = {};
  /// After so many passes a uniform run that has not come to it is given up.
  std::uint32_t uniform_passes = 1u << 14;

  /// "24 spp", "3 s" or "relmse 0.01", for messages.
  std::string text() const;
  /// What of it a run took or reached.
  double of(const Measurement& run) const;
};

/// The threshold that meets a budget.
struct Calibration {
  LaneSettings settings;  ///< with all thresholds of its estimator scaled by `factor`
  double factor = 1.0;    ///< against the thresholds that it began with
  Measurement result;     ///< after the last pass; values: the error, if that is the budget
  bool met = false;       ///< samples and seconds within a hundredth; an error that is not above
  std::string reason;     ///< where it was not met: why, and what the nearest is, in one line
  /// Where an error was met, but by more than a hundredth: why no threshold is nearer, in one line.
  std::string note;
  int runs = 0;         ///< that it took
  CappedPixels capped;  ///< of the run that `result` is of
};

/// Finds, by replays, the factor on all thresholds of a lane with which a run of so many passes
/// meets the budget.
///
/// The higher the thresholds, the fewer samples and seconds: such a budget is met as nearly as it
/// can be, by bisection, and where it lies beyond what any threshold gives, the nearest end is
/// returned. An error is an upper bound, and not monotone in the threshold: a scan finds the
/// thresholds that cost least (in rays; in samples where nothing is traced) of those that meet it
/// (see scan_thresholds), or the ones of the least error.
///
/// A run depends on nothing but samples and settings, so that the same budget gives the same
/// thresholds, except that measured seconds are never twice the same. An estimator without a
/// threshold, uniform, has no factor: it runs as many passes as meet the budget, for an error the
/// first that do.
///
/// Nothing if `stop` ended it. Throws std::invalid_argument for a budget that is not exactly one,
/// or for an error without a reference in the experiment.
std::optional<Calibration> calibrate(Experiment& experiment, const LaneSettings& settings,
                                     const CommonBudget& budget, std::stop_token stop = {});

/// The settings with all their thresholds scaled.
LaneSettings scaled_thresholds(LaneSettings settings, double factor);

}  // namespace quartet
