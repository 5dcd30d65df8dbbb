#include "renderer/study/threshold_scan.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quartet {
namespace {

// Nearer than this to the target, or to each other, the search between two factors ends.
constexpr double spot_on_quality = 1.001;
constexpr double spot_on_factor = 1.0 + 1e-5;
// Between steps of two nothing narrower than this is looked for around the best of those that miss.
constexpr double narrow_dip = 1.02;
constexpr std::size_t most_scanned = 120;

class Scan {
 public:
  explicit Scan(const RunWithFactor& run) : run_(run) {}

  std::optional<ThresholdScan> search() {
    if (!spread() || !look_around_best() || !refine()) {
      return std::nullopt;
    }
    const bool always = std::ranges::all_of(runs_, &ScannedRun::met);
    return ThresholdScan{best(), always, std::move(runs_)};
  }

 private:
  /// False if stopped.
  bool add(double factor) {
    const std::optional<ScannedRun> run = run_(factor);
    if (run) {
      runs_.insert(std::ranges::upper_bound(runs_, factor, {}, &ScannedRun::factor), *run);
    }
    return run.has_value();
  }

  ScannedRun at(double factor) const {
    return *std::ranges::find(runs_, factor, &ScannedRun::factor);
  }

  ScannedRun best() const {
    ScannedRun found = runs_.front();
    for (const ScannedRun& run : runs_) {
      found = run.is_better_than(found) ? run : found;
    }
    return found;
  }

  /// The extremes, and outwards from 1 until a run is that of an extreme. Far out the steps are
  /// wider: there is a pixel or two for long.
  bool spread() {
    if (!add(extreme_factor) || !add(1.0 / extreme_factor) || !add(1.0)) {
      return false;
    }
    for (const bool up : {true, false}) {
      const ScannedRun end = at(up ? extreme_factor : 1.0 / extreme_factor);
      ScannedRun last = at(1.0);
      for (int exponent = 1; exponent <= 20 && !last.same_run(end);
           exponent += exponent < 8 ? 1 : 2) {
        const double factor = std::ldexp(1.0, up ? exponent : -exponent);
        if (!add(factor)) {
          return false;
        }
        last = at(factor);
      }
    }
    return true;
  }

  /// Where no run meets the target, whether one does on either side of the best.
  bool look_around_best() {
    for (double step = std::sqrt(2.0); !best().met() && step > narrow_dip; step = std::sqrt(step)) {
      const double middle = best().factor;
      if (middle >= extreme_factor || middle <= 1.0 / extreme_factor) {
        return true;
      }
      if (!add(middle / step) || !add(middle * step)) {
        return false;
      }
    }
    return true;
  }

  /// The lower one of the two neighbours between which the cheapest that meets the target may lie;
  /// nothing if nowhere one may be cheaper than the best.
  std::optional<std::size_t> most_promising() const {
    const double cost_to_beat = best().cost;
    std::optional<std::size_t> found;
    double least = 0.0;
    for (std::size_t i = 0; i + 1 < runs_.size(); ++i) {
      const ScannedRun& low = runs_[i];
      const ScannedRun& high = runs_[i + 1];
      const ScannedRun& meets = low.met() ? low : high;
      const double cost = std::min(low.cost, high.cost);
      const bool open = low.met() != high.met() && meets.quality > spot_on_quality &&
                        high.factor > low.factor * spot_on_factor && cost < cost_to_beat;
      if (open && (!found || cost < least)) {
        found = i;
        least = cost;
      }
    }
    return found;
  }

  bool refine() {
    while (best().met() && runs_.size() < most_scanned) {
      const std::optional<std::size_t> i = most_promising();
      if (!i) {
        return true;
      }
      if (!add(std::sqrt(runs_[*i].factor * runs_[*i + 1].factor))) {
        return false;
      }
    }
    return true;
  }

  const RunWithFactor& run_;
  std::vector<ScannedRun> runs_;
};

}  // namespace

bool ScannedRun::is_better_than(const ScannedRun& other) const {
  if (met() != other.met()) {
    return met();
  }
  if (met() && cost != other.cost) {
    return cost < other.cost;
  }
  if (!met() && quality != other.quality) {
    return quality > other.quality;
  }
  return std::abs(std::log(factor)) < std::abs(std::log(other.factor));
}

std::optional<ThresholdScan> scan_thresholds(const RunWithFactor& run) {
  return Scan(run).search();
}

}  // namespace quartet
