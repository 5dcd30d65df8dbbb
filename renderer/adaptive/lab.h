#pragma once

#include <tbb/task_arena.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "renderer/adaptive/lane.h"
#include "renderer/trace/integrator.h"
#include "renderer/trace/store/sample_store.h"

namespace quartet {

struct LabOptions {
  int threads = 0;                            ///< 0: one a processor
  std::size_t memory = std::size_t(2) << 30;  ///< of the sample stores, bytes
  FilmStatistics statistics;                  ///< beside what the estimators need
  SamplerId sampler = SamplerId::sobol;       ///< of the sources, for the variance of means
  /// The truth, for estimators that need it; as large as the picture.
  std::shared_ptr<const RadianceImage> reference;
  /// Samples with random numbers of their own, for SampleMode::unbiased; see pilot_source().
  SampleSource pilot_source;
};

/// Several lanes over one store of samples, and a second one for pilot runs where a lane has one.
class Lab {
 public:
  /// Throws std::invalid_argument where a lane needs a reference or a pilot source that is not
  /// there, or a reference is of another size than the picture; so do set_settings and set_lanes.
  Lab(SampleSource source, int width, int height, std::span<const LaneSettings> lane_settings,
      const LabOptions& options = {});

  int width() const { return shown_.store.width(); }
  int height() const { return shown_.store.height(); }
  std::span<const Lane> lanes() const { return lanes_; }
  const SampleStore& store() const { return shown_.store; }
  /// Null if no lane has had a pilot run.
  const SampleStore* pilot_store() const { return pilot_ ? &pilot_->store : nullptr; }
  /// The pass that the lanes furthest behind have finished.
  std::uint32_t pass() const;
  /// The threads it works on, for what others make of its lanes.
  tbb::task_arena& threads() const { return arena_; }

  // Of both stores:
  std::uint64_t stored_samples() const;
  std::size_t stored_bytes() const;
  /// Whether samples were ever forgotten, so that a replay must trace them again.
  bool partial() const;

  /// Advances the lanes that are furthest behind by one pass, tracing what the stores lack.
  /// Returns false if `stop` ended it early: then no lane has moved, and what was traced is kept. A
  /// store without samples is filled with its first ones whatever `stop` says.
  bool run_pass(std::stop_token stop = {});

  /// Advances one lane alone by one pass, wherever the others are; else like run_pass.
  bool run_pass_of(std::size_t lane, std::stop_token stop = {});

  /// run_pass, but up to pass `last` at once where stored samples allow, without a look at what is
  /// between. Lanes that have to go pass by pass follow in later calls.
  bool run_passes(std::uint32_t last, std::stop_token stop = {});

  /// Gives a lane other settings: it starts again at pass 0, out of stored samples.
  void set_settings(std::size_t lane, const LaneSettings& settings);

  /// Gives the lab these lanes. One whose settings and statistics stay as they are, and whose
  /// reference does if it needs one, keeps its pass; the others start again at pass 0, out of
  /// stored samples.
  void set_lanes(std::span<const LaneSettings> lane_settings, FilmStatistics statistics,
                 std::shared_ptr<const RadianceImage> reference = nullptr);

  /// Writes `error_of` the picture into the last record of each lane where it is not known yet.
  void measure(const std::function<TrueError(const Film&)>& error_of);
  void forget_true_errors();

  /// Back to pass 0, for those of the first `count` lanes that are past `pass`; the stores are
  /// kept.
  void rewind_past(std::uint32_t pass, std::size_t count = SIZE_MAX);

 private:
  /// Where samples come from, and where they are kept.
  struct Stream {
    SampleSource source;
    SampleStore store;
  };

  void check(std::span<const LaneSettings> lane_settings, const RadianceImage* reference) const;
  void make_pilot();
  LaneStores stores() const;
  LaneInputs lane_inputs() const {
    return {options_.statistics, options_.reference, options_.sampler};
  }
  bool takes_from(const Lane& lane, const Stream& stream) const;

  std::vector<Lane*> lanes_at(std::uint32_t pass);
  bool step(std::span<Lane* const> moving, std::stop_token stop);
  void advance(std::span<Lane* const> moving);
  bool replay(std::uint32_t pass, std::uint32_t last);
  bool trace(Stream& stream, std::span<Lane* const> moving, std::stop_token stop);
  std::vector<SampleWish> wishes_of(std::span<Lane* const> lanes, const Stream& stream) const;
  std::size_t coming_bytes(const Stream& stream);
  void forget(Stream& stream);
  void charge(bool one_pass);

  LabOptions options_;
  Stream shown_;
  std::optional<Stream> pilot_;
  std::vector<Lane> lanes_;
  SampleCosts charged_by_;  // what all records of all lanes are charged by
  mutable tbb::task_arena arena_;
};

/// The tracer as a source of samples.
SampleSource sample_source(std::shared_ptr<const TraceScene> scene, const RenderSettings& settings);

/// The same with other random numbers: those of a seed that the settings' decide and that no one
/// would choose.
SampleSource pilot_source(std::shared_ptr<const TraceScene> scene, const RenderSettings& settings);

}  // namespace quartet
