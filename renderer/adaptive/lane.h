#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/adaptive/film/film.h"
#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/pass_history.h"
#include "renderer/adaptive/policies/policy.h"
#include "renderer/adaptive/replay.h"
#include "renderer/trace/store/sample_store.h"

namespace quartet {

/// Where lanes find their samples: the ones that are shown and, for SampleMode::unbiased, those of
/// the pilot run.
struct LaneStores {
  const SampleStore& shown;
  const SampleStore* pilot = nullptr;
};

/// What all lanes of a lab have in common, beside samples.
struct LaneInputs {
  FilmStatistics statistics;  ///< of the film that is shown, beside what the estimator needs
  /// The truth, for an estimator that needs it; as large as the picture.
  std::shared_ptr<const RadianceImage> reference;
  SamplerId sampler = SamplerId::sobol;  ///< of all samples
};

/// One of the experiments that run side by side: its settings and what came of them. Its state is a
/// function of (samples, settings, pass), with an oracle also of the reference, and of nothing
/// else.
class Lane {
 public:
  Lane(int width, int height, const LaneSettings& settings, const LaneInputs& inputs);

  const LaneSettings& settings() const { return settings_; }
  /// What is shown.
  const Film& film() const { return film_; }
  /// The film whose errors decide: a pilot of SampleMode::unbiased, or what is shown.
  const Film& deciding_film() const { return pilot_ ? *pilot_ : film_; }
  /// Raw error of the deciding film, channels × pixels; empty before the first pass and for
  /// estimators without one.
  std::span<const float> error() const { return error_; }
  /// What the next pass will take.
  const Plan& plan() const { return plan_; }
  /// Samples that each pixel has used, rejected ones included; those of a pilot come on top.
  std::span<const std::uint32_t> taken() const { return taken_; }
  std::uint32_t pass() const { return history_.passes(); }
  /// See pass_history.h: of a long run it has some passes left out.
  std::span<const PassRecord> history() const { return history_.records(); }

  // A pass, whose planned samples must be in the stores, has three steps, so that lanes can take
  // samples together.

  void begin_pass(const LaneStores& stores);
  /// Takes what is planned for one row of tiles; calls for different rows may come from different
  /// threads.
  void take(const LaneStores& stores, int tile_row);
  /// Estimates and plans, on the threads of the current TBB arena. `take_seconds` is what taking
  /// cost. The pass's record is charged for its samples by charge().
  void end_pass(double take_seconds);

  // Several passes together.

  /// Whether it can take passes from where it stands by a Replay, and has the samples of the next.
  bool can_replay(const SampleStore& store) const;
  /// At most so many passes.
  std::unique_ptr<Replay> begin_replay(const SampleStore& store, std::uint32_t passes);
  /// Takes over what came of it, after run_replays().
  void end_replay(const SampleStore& store, Replay& replay);

  /// What its samples took is from now on what these costs say; `last_only`: all records but the
  /// last were charged by the same.
  void charge(const SampleCosts& costs, bool last_only) { history_.charge(costs, last_only); }
  /// Writes the error of the picture into the last record.
  void set_true_error(const TrueError& error) { history_.back().truth = error; }
  /// Of all records.
  void forget_true_errors();

  /// Sums up what was looked up in one of the stores, before it forgets its means, so that the lane
  /// can go on adding.
  void catch_up_shown(const SampleStore& store);
  void catch_up_pilot(const SampleStore& store);

  /// Back to pass 0, with other settings or other inputs.
  void restart(const LaneSettings& settings, const LaneInputs& inputs);

 private:
  /// What a row of tiles adds to a pass's record.
  struct RowTotal {
    std::uint32_t max_spp = 0;
    // Of all samples where they were looked up, else of those of this pass.
    SampleCosts::Work shown;
    SampleCosts::Work pilot;
  };

  std::uint32_t count(std::size_t begin, std::size_t end);
  void record_pass(const PassTotal& total);
  void replan(std::uint32_t pass);

  LaneSettings settings_;
  std::shared_ptr<const RadianceImage> reference_;
  Film film_;
  std::optional<Film> pilot_;
  std::vector<float> error_;
  std::vector<std::uint32_t> taken_;
  Plan plan_;
  PassHistory history_;
  std::vector<RowTotal> rows_;
  bool looks_up_shown_ = false;
  bool looks_up_pilot_ = false;
  // Of all samples so far.
  SampleCosts::Work shown_work_;
  SampleCosts::Work pilot_work_;
  double own_seconds_ = 0.0;
};

}  // namespace quartet
