#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "renderer/trace/store/sample_costs.h"

namespace quartet {

/// How far a picture is from a reference.
struct TrueError {
  /// In the metric of whoever had it measured (Lab::measure); NaN: it was not.
  double error = std::numeric_limits<double>::quiet_NaN();
  /// How much more light it holds: measure/energy.h.
  double energy = std::numeric_limits<double>::quiet_NaN();
};

/// A lane at the end of one pass.
struct PassRecord {
  std::uint32_t pass = 0;  ///< from 1
  /// Taken so far, rejected ones and those of a pilot run included: what the lane is charged for.
  std::uint64_t samples = 0;
  std::uint64_t pilot_samples = 0;  ///< of these, the ones of a pilot, which are not shown
  /// That these samples took, counted: the same on every machine. Samples that nobody traced took
  /// none.
  std::uint64_t rays = 0;
  std::uint32_t max_spp = 0;   ///< of the pixel with most, without those of a pilot
  std::uint64_t not_done = 0;  ///< pixels: Plan::not_done
  /// What the lane would have taken alone on all threads, in wall-clock seconds: its samples,
  /// whoever traced them, its share of reading them, and its own estimates and plans: as measured,
  /// which for passes that were replayed together (replay.h) is less than for one after the other,
  /// and small beside tracing.
  double seconds = 0.0;
  double tracing_seconds = 0.0;  ///< of these, its samples: SampleCosts of the work that they are
  TrueError truth = {};
};

/// The passes of a lane in bounded memory: all of them up to `most_records`, then every second one,
/// every fourth and so on, and always the last. Which are kept is a function of how many there
/// were.
class PassHistory {
 public:
  static constexpr std::size_t most_records = 4096;

  /// `record.pass` must be the one after the last. Its seconds are those of the lane itself; what
  /// tracing took is added by charge(), for `work`.
  void push(const PassRecord& record, const SampleCosts::Work& work);
  void clear();

  /// Charges the records for the work of their samples, all by these costs: what a record said
  /// before is replaced. `last_only`: the others were charged by the same.
  void charge(const SampleCosts& costs, bool last_only);

  std::uint32_t passes() const { return records_.empty() ? 0 : records_.back().pass; }
  PassRecord& back() { return records_.back(); }
  std::span<PassRecord> records() { return records_; }
  std::span<const PassRecord> records() const { return records_; }

 private:
  /// What a record is charged for.
  struct Charge {
    SampleCosts::Work work;
    double own_seconds;
  };

  std::vector<PassRecord> records_;
  std::vector<Charge> charges_;  // of the records
  std::uint32_t stride_ = 1;
};

}  // namespace quartet
