#pragma once

#include <vector>

#include "renderer/adaptive/film.h"
#include "renderer/adaptive/policy.h"
#include "renderer/trace/sample_store.h"

namespace quartet {

/// A lane at the end of one frame.
struct FrameRecord {
  std::uint32_t frame = 0;    ///< from 1
  std::uint64_t samples = 0;  ///< taken so far, rejected ones included
  std::uint32_t max_spp = 0;  ///< of the pixel with most
  std::uint64_t refined = 0;  ///< pixels whose error is above a threshold
  /// What the lane would have taken alone on all threads, in wall-clock seconds: its samples,
  /// whoever traced them, its share of reading them, and its own estimates and plans.
  double seconds = 0.0;
};

/// One of the experiments that run side by side: a policy and what came of it. Its state is a
/// function of (samples, policy, frame) and of nothing else.
class Lane {
 public:
  Lane(int width, int height, const SamplingPolicy& policy, FilmStatistics statistics);

  const SamplingPolicy& policy() const { return policy_; }
  const Film& film() const { return film_; }
  /// Raw error, channels × pixels; empty before the first frame and for estimators without one.
  std::span<const float> error() const { return error_; }
  /// What the next frame will take.
  const Plan& plan() const { return plan_; }
  std::span<const std::uint32_t> taken() const { return taken_; }
  std::uint32_t frame() const { return std::uint32_t(history_.size()); }
  std::span<const FrameRecord> history() const { return history_; }

  // A frame, whose planned samples must be in the store, has three steps, so that lanes can take
  // samples together.

  void begin_frame(const SampleStore& store);
  /// Takes what is planned for one row of tiles; calls for different rows may come from different
  /// threads. Where the store has means and the film wants nothing else, they are looked up, else
  /// samples are added, with the same result to the bit.
  void take(const SampleStore& store, int tile_row);
  /// Estimates and plans, on the threads of the current TBB arena. `take_seconds` is what taking
  /// cost.
  void end_frame(double take_seconds);

  /// Sums up what was looked up, before the store forgets its means, so that it can go on adding.
  void catch_up(const SampleStore& store);

  /// Back to frame 0, with another policy.
  void restart(const SamplingPolicy& policy);

 private:
  /// What a row of tiles adds to a frame's record.
  struct RowTotal {
    std::uint32_t max_spp = 0;
    double seconds = 0.0;
  };

  RowTotal count(const SampleStore& store, std::size_t begin, std::size_t end);
  void look_up(const SampleStore& store, int tile_row);
  void look_up_with_rejected(const SampleStore& store, const SampleStore::TileMeans& tile);
  void accumulate(const SampleStore& store, std::size_t begin, std::size_t end);
  void replan();

  SamplingPolicy policy_;
  Film film_;
  std::vector<float> error_;
  std::vector<std::uint32_t> taken_;
  Plan plan_;
  std::vector<FrameRecord> history_;
  std::vector<RowTotal> rows_;
  bool looks_up_ = false;
  double own_seconds_ = 0.0;
};

}  // namespace quartet
