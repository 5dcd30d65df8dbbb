#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace quartet {

/// What a run came to whose thresholds are all scaled by a factor.
struct ScannedRun {
  double factor = 1.0;
  double quality = 0.0;  ///< how many times better than the target its error is; met from 1 on
  double cost = 0.0;     ///< what it took, in whatever is compared
  bool met() const { return quality >= 1.0; }
  /// Of those that meet the target the cheapest, of equal ones the nearest to factor 1; of those
  /// that do not the one of the least error.
  bool is_better_than(const ScannedRun& other) const;
  bool same_run(const ScannedRun& other) const {
    return quality == other.quality && cost == other.cost;
  }
};

/// Of all factors that were tried, what is to be said.
struct ThresholdScan {
  ScannedRun best;               ///< none is better than it
  bool always = false;           ///< whether every factor that was tried meets the target
  std::vector<ScannedRun> runs;  ///< rising factors
};

/// Runs with a factor; nothing if it was stopped. The same factor gives the same run.
using RunWithFactor = std::function<std::optional<ScannedRun>(double factor)>;

/// Thresholds so high that everything is done, and their inverse so low that nothing is; products
/// with any sensible default are still ordinary floats.
inline constexpr double extreme_factor = 0x1p50;

/// Finds the cheapest factor whose error is at most a target. An error is not monotone in the
/// threshold: samples that a lane stopped before may hold light that it had not seen. So factors
/// are tried a factor of two apart, out to where the run is that of an extreme; then those
/// neighbours of which one meets the target are bisected, the cheapest first, as long as cheaper
/// ones may lie between them. If none meets it, the neighbours of the best are looked into. Nothing
/// if a run was stopped.
std::optional<ThresholdScan> scan_thresholds(const RunWithFactor& run);

}  // namespace quartet
