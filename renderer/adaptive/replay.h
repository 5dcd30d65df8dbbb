#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "renderer/adaptive/film/film.h"
#include "renderer/adaptive/lane_settings.h"
#include "renderer/trace/store/sample_store.h"

namespace quartet {

/// What one pass adds to a lane's record.
struct PassTotal {
  std::uint64_t samples = 0;   ///< that it took
  std::uint64_t planned = 0;   ///< that the next one is to take
  std::uint64_t not_done = 0;  ///< pixels at its end
  std::uint32_t max_spp = 0;   ///< of the pixel with most
  SampleCosts::Work work;      ///< of all samples until its end
};

/// Several passes of a lane at once, out of the means of a store.
///
/// A pass after the other, over whole pictures, would read and write films, errors and plans that
/// fit no cache, and wait for memory most of the time. But a pixel's plan depends on the rows at
/// most two away. So all passes go down the picture together, each two rows behind the one before:
/// of the passes between, only the last rows are ever in memory. What comes out is equal to the
/// bit.
///
/// Used for lanes whose estimator has a WindowKernel.
class Replay {
 public:
  /// A lane at the end of a pass, and what it is to take next.
  struct Start {
    const LaneSettings& settings;
    std::uint32_t pass;
    std::span<const std::uint32_t> taken;
    std::span<const std::uint16_t> wanted;
  };

  /// Takes at most `passes` of them, at least 1; the store holds the samples of the first. Film and
  /// error are the lane's, which may not look at them before the replay has run.
  Replay(const SampleStore& store, const Start& start, std::uint32_t passes, Film& film,
         std::span<float> error);

  // After run_replays():

  /// Those that the store has the samples of.
  std::uint32_t passes() const { return passes_; }
  std::span<const PassTotal> totals() const { return totals_; }  ///< of each
  /// What the lane has taken, and what it wants next.
  std::vector<std::uint32_t>& taken() { return taken_; }
  std::vector<std::uint16_t>& wanted() { return wanted_; }
  /// What it took, or would have taken alone on all threads.
  double seconds() const { return seconds_; }

 private:
  friend void run_replays(std::span<const std::unique_ptr<Replay>> replays);
  class Band;

  void restart(std::uint32_t passes);
  void run(int begin, int end, double threads);

  const SampleStore& store_;
  const Start start_;
  std::uint32_t passes_;
  Film& film_;
  std::span<float> error_;
  // Of these passes, those that the store has the samples of, as far as is known. If they are not
  // all, nothing else is of use, but to start again with so many.
  std::atomic<std::uint32_t> possible_;
  std::vector<std::uint32_t> taken_;
  std::vector<std::uint16_t> wanted_;
  std::mutex mutex_;  // guards what follows
  std::vector<PassTotal> totals_;
  double seconds_ = 0.0;
};

/// Runs them all on the threads of the current TBB arena.
void run_replays(std::span<const std::unique_ptr<Replay>> replays);

}  // namespace quartet
