#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "renderer/adaptive/effort.h"
#include "renderer/base/interval.h"
#include "renderer/measure/capped.h"
#include "renderer/measure/error_parts.h"
#include "renderer/measure/rejected_count.h"
#include "renderer/study/sample_world.h"

namespace quartet {

/// Is one lane better than another at equal effort? Both run over the same samples, seed by seed,
/// so that differences are paired.
struct VersusPlan {
  std::array<LaneSettings, 2> lanes;
  Effort effort = Effort::mean_spp;  ///< by which they are equal
  double goal = 32.0;                ///< how much of it
  std::uint32_t seeds = 8;
  std::vector<MetricId> metrics;  ///< none in decibels: they have no ratio
};

/// One lane with one seed, at the effort where both are compared: errors between two passes are on
/// a straight line in logarithms, energies on one in the effort.
struct VersusRun {
  std::vector<Measurement> passes;  ///< all, as far as the goal
  std::vector<double> errors;       ///< of the plan's metrics
  double energy = 0.0;
};

struct VersusSeed {
  std::array<VersusRun, 2> runs;
  /// The goal; less where a lane was done before it, since with more it would not get better; more
  /// where a lane's first pass takes more.
  double effort = 0.0;
};

struct VersusResult {
  std::vector<VersusSeed> seeds;
  std::array<ErrorParts, 2> parts = {};  ///< of MSE at the ends of the runs, radiance²
  bool partial = false;                  ///< memory was short: some samples were traced again
  RejectedCount rejected;
  CappedPixels capped;
};

/// Nothing if `stop` ended it. `progress` is told how much is done and what is at work.
std::optional<VersusResult> run_versus(
    const SampleWorld& world, const VersusPlan& plan, std::stop_token stop,
    const std::function<void(double, std::string_view)>& progress);

/// What each seed says.
std::vector<double> over_seeds(const VersusResult& result,
                               const std::function<double(const VersusSeed&)>& number);

/// The first lane's error over the second's, of one of the plan's metrics: geometric mean over the
/// seeds with its interval at confidence 1 − p.
Interval error_ratio(const VersusResult& result, std::size_t metric, double p);
/// energy_error() of a lane, mean over the seeds.
Interval energy_of(const VersusResult& result, std::size_t lane, double p);
/// The last effort at which the lead changes from one lane to the other, by the mean over the seeds
/// of the logarithm of error_ratio; nothing if the same one is better throughout.
std::optional<double> crossing(const VersusResult& result, const VersusPlan& plan,
                               std::size_t metric);

}  // namespace quartet
