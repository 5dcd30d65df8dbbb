#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "renderer/adaptive/lane.h"
#include "renderer/trace/integrator.h"
#include "renderer/trace/sample_store.h"

namespace quartet {

struct LabOptions {
  int threads = 0;                            ///< 0: one a processor
  std::size_t memory = std::size_t(2) << 30;  ///< of the sample store, bytes
  FilmStatistics statistics;                  ///< beside what the estimators need
};

/// Several lanes over one store of samples.
class Lab {
 public:
  Lab(SampleSource source, int width, int height, std::span<const SamplingPolicy> policies,
      const LabOptions& options = {});

  int width() const { return store_.width(); }
  int height() const { return store_.height(); }
  std::span<const Lane> lanes() const { return lanes_; }
  const SampleStore& store() const { return store_; }
  /// The frame that the lanes furthest behind have finished.
  std::uint32_t frame() const;

  /// Advances the lanes that are furthest behind by one frame, tracing what the store lacks.
  /// Returns false if `stop` ended it early: then no lane has moved, and what was traced is kept. A
  /// store without samples is filled with its first ones whatever `stop` says.
  bool run_frame(std::stop_token stop = {});

  /// Gives a lane another policy: it starts again at frame 0, out of stored samples.
  void set_policy(std::size_t lane, const SamplingPolicy& policy);

  /// Gives the lab these lanes. One whose policy and statistics stay as they are keeps its frame;
  /// the others start again at frame 0, out of stored samples.
  void set_lanes(std::span<const SamplingPolicy> policies, FilmStatistics statistics);

  /// Back to frame 0, for all lanes that are past `frame`; the store is kept.
  void rewind_past(std::uint32_t frame);

 private:
  void advance(std::uint32_t frame);
  bool trace(std::uint32_t frame, std::stop_token stop);
  void forget();

  SampleSource source_;
  LabOptions options_;
  SampleStore store_;
  std::vector<Lane> lanes_;
  // Samples that a frame needs, first and past the last of each pixel.
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> end_;
  tbb::task_arena arena_;
};

/// The tracer as a source of samples.
SampleSource sample_source(std::shared_ptr<const TraceScene> scene, const RenderSettings& settings);

}  // namespace quartet
