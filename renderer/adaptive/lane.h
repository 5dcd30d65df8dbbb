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
  /// What the lane would have taken alone, in wall-clock seconds: its samples, whoever traced them,
  /// and its own estimates and plans.
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

  /// Takes the planned samples out of the store, where they must be, then estimates and plans.
  void advance(const SampleStore& store);

 private:
  void take_samples(const SampleStore& store);
  void replan();

  SamplingPolicy policy_;
  Film film_;
  std::vector<float> error_;
  std::vector<std::uint32_t> taken_;
  Plan plan_;
  std::vector<FrameRecord> history_;
  double own_seconds_ = 0.0;
};

}  // namespace quartet
