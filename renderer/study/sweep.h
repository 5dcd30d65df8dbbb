#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string_view>
#include <vector>

#include "renderer/measure/capped.h"
#include "renderer/measure/error_curve.h"
#include "renderer/measure/quality.h"
#include "renderer/measure/rejected_count.h"
#include "renderer/study/experiment.h"

namespace quartet {

/// What experiments draw their samples from, seed by seed.
struct SampleWorld {
  std::function<SampleSource(std::uint64_t seed)> source;
  std::function<SampleSource(std::uint64_t seed)>
      pilot;                     ///< for SampleMode::unbiased; may be empty
  std::uint64_t first_seed = 0;  ///< then the ones that follow
  int width = 0;
  int height = 0;
  LabOptions lab;
  std::shared_ptr<const RadianceImage> reference;  ///< as large as the picture
};

/// The options of a lab that draws from it with a seed: with its pilot source, and the reference
/// for estimators that look at it.
LabOptions lab_options(const SampleWorld& world, std::uint64_t seed);
/// Runs over samples of one seed, none of which is traced yet.
Experiment make_experiment(const SampleWorld& world, std::uint64_t seed);

/// The tracer, with the settings but for their seed, which is the first one.
SampleWorld sample_world(std::shared_ptr<const TraceScene> scene, const RenderSettings& settings,
                         const LabOptions& lab, std::shared_ptr<const RadianceImage> reference);

/// Every lane at a geometric range of thresholds, if it has any, with several seeds.
struct SweepPlan {
  /// With their default thresholds; of a sweep's estimators.
  std::vector<LaneSettings> lane_settings;
  int thresholds = 8;
  double low = 0.1;  ///< factor on the default thresholds
  double high = 10.0;
  std::uint32_t seeds = 3;
  /// The end of each run. The uniform baseline goes on until it has taken more samples and rays
  /// than the dearest run, so that all are compared with what it really gives for the same.
  StopConditions stop;
  std::vector<MetricId> metrics{default_metric};
};

/// One run of a sweep.
struct SweepRun {
  LaneSettings settings;
  double factor = 1.0;  ///< on the default thresholds; 1 where there are none
  std::uint64_t seed = 0;
  Measurement end = {};
  EstimatorQuality quality = {};
  double oracle_distance = 0.0;  ///< share_distance() of its samples and the oracle's weights
};

struct SweepResult {
  std::vector<SweepRun> runs;  ///< seed by seed, lane by lane, by rising thresholds
  /// The baseline, one run a seed, at powers of two of its passes, at those next to where other
  /// runs ended, and at its end.
  std::vector<std::vector<Measurement>> uniform;
  std::uint64_t first_seed = 0;
  std::uint64_t samples_traced = 0;
  std::uint64_t samples_used = 0;  ///< by all runs together
  bool partial = false;            ///< memory was short: some samples were traced again
  RejectedCount rejected;          ///< of the run that met most
  CappedPixels capped;             ///< of the run that has most
};

/// The factors of a sweep, rising, with 1, the default, among them.
std::vector<double> sweep_factors(const SweepPlan& plan);

/// Nothing if `stop` ended it. `progress` is told how much is done and what is at work.
std::optional<SweepResult> run_sweep(const SampleWorld& world, const SweepPlan& plan,
                                     std::stop_token stop,
                                     const std::function<void(double, std::string_view)>& progress);

/// One point of a curve: the runs of one lane and factor with all seeds.
struct SweepPoint {
  LaneSettings settings;
  double factor = 1.0;
  double seconds = 0.0;    ///< median
  double mean_spp = 0.0;   ///< median
  double mean_rays = 0.0;  ///< median, a pixel
  double error = 0.0;      ///< median
  double error_low = 0.0;
  double error_high = 0.0;
  double energy = 0.0;  ///< median of energy_error()
  /// By Effort: median over the seeds of the error over that of uniform sampling with the same seed
  /// at the same effort, between two of its passes: below 1 it beats uniform. NaN for metrics in
  /// decibels, for rays where nothing is traced, and where uniform took fewer seconds.
  std::array<double, 3> against_uniform = {};
};

/// Points of all lanes, in the order of the plan, by rising thresholds.
std::vector<SweepPoint> sweep_points(const SweepResult& result, const SweepPlan& plan,
                                     std::size_t metric);
/// Those of the baseline, by rising passes: the ones at which all seeds were measured.
std::vector<SweepPoint> uniform_points(const SweepResult& result, std::size_t metric);

/// Those that no other point beats in both time and error, by rising time: the Pareto front.
/// `higher_is_better` speaks of the error.
std::vector<SweepPoint> pareto_front(std::vector<SweepPoint> points, bool higher_is_better);

}  // namespace quartet
