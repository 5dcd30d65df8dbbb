#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "renderer/measure/capped.h"
#include "renderer/measure/error_parts.h"
#include "renderer/measure/quality.h"
#include "renderer/measure/rejected_count.h"
#include "renderer/study/sample_world.h"

namespace quartet {

/// Which lanes of a sweep are also run in mode unbiased, with the same thresholds: their twins. A
/// twin's pilot is charged to its samples, rays and seconds.
enum class Twins { none, at_defaults, at_all };

/// Every lane at a geometric range of thresholds, if it has any, with several seeds.
struct SweepPlan {
  /// With their default thresholds; of a sweep's estimators, each once.
  std::vector<LaneSettings> lane_settings;
  int thresholds = 8;
  double low = 0.1;  ///< factor on the default thresholds
  double high = 10.0;
  Twins twins = Twins::at_all;
  std::uint32_t seeds = 3;
  /// The end of each run. The uniform baseline goes on until it has taken more samples and rays
  /// than the dearest run, so that all are compared with what it really gives for the same.
  StopConditions stop;
  /// The first one is what trajectories are measured in; the others only at the ends.
  std::vector<MetricId> metrics{default_metric};
};

/// One line of a sweep: a lane at fixed thresholds.
struct SweepLane {
  LaneSettings settings;
  double factor = 1.0;  ///< on the default thresholds; 1 where there are none
  bool twin = false;    ///< of the lane before it that is not

  bool operator==(const SweepLane&) const = default;
};

/// The factors of a sweep, rising, with 1, the default, among them.
std::vector<double> sweep_factors(const SweepPlan& plan);
/// All lines, lane by lane: those of its thresholds, rising, then those of its twins.
std::vector<SweepLane> sweep_lanes(const SweepPlan& plan);

/// One line with one seed.
struct SweepRun {
  SweepLane lane;
  std::uint64_t seed = 0;
  /// After some passes on the way, rising: powers of two and what is between them. Measured in the
  /// plan's first metric alone.
  std::vector<Measurement> way = {};
  Measurement end = {};
  EstimatorQuality quality = {};
  double oracle_distance = 0.0;  ///< share_distance() of its samples and the oracle's weights
};

/// Of all seeds of a line, in parts_metric().
struct SweepParts {
  std::map<std::uint32_t, ErrorParts> way;  ///< after passes that all seeds were measured after
  ErrorParts end;
};

struct SweepResult {
  std::vector<SweepRun> runs;  ///< seed by seed, in the order of sweep_lanes()
  /// The baseline, one run a seed, at powers of two of its passes, at those next to where other
  /// runs ended, and at its end.
  std::vector<std::vector<Measurement>> uniform;
  std::vector<SweepParts> parts;  ///< of each line; empty if no metric is a mean of squares
  SweepParts uniform_parts;       ///< on the way alone: seeds end after different passes
  /// What the pictures that the parts are made of take in memory, and whether that was more than
  /// LabOptions::memory, so that there are none on the way.
  std::size_t bytes_of_parts = 0;
  bool parts_at_ends_only = false;
  std::uint64_t first_seed = 0;
  std::uint64_t samples_traced = 0;
  std::uint64_t samples_used = 0;  ///< by all runs together
  bool partial = false;            ///< memory was short: some samples were traced again
  RejectedCount rejected;          ///< of the run that met most
  CappedPixels capped;             ///< of the run that has most
};

/// What is split into bias² and variance: the plan's first metric, or where that is no mean of
/// squares the first of the others that is; null if none is.
const Metric* parts_metric(const SweepPlan& plan);

/// Nothing if `stop` ended it. `progress` is told how much is done and what is at work.
std::optional<SweepResult> run_sweep(const SampleWorld& world, const SweepPlan& plan,
                                     std::stop_token stop,
                                     const std::function<void(double, std::string_view)>& progress);

}  // namespace quartet
