#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/adaptive/effort.h"
#include "renderer/base/interval.h"
#include "renderer/study/sweep.h"

namespace quartet {

/// Confidence of each interval of a sweep, by itself, over its seeds.
inline constexpr double sweep_confidence = 0.95;

/// One point of a line: all seeds after so many passes, or at the ends of their runs.
struct SweepPoint {
  std::uint32_t pass = 0;  ///< 0: the ends, which came after different passes
  double seconds = 0.0;    ///< mean, as the others
  double mean_spp = 0.0;
  double mean_rays = 0.0;  ///< a pixel
  Interval error;
  Interval energy;          ///< energy_error()
  ErrorParts parts;         ///< of the error; NaN where they are not known
  double relmse_top = 0.0;  ///< mean of Measurement::relmse_top; NaN where it was not measured
  /// By Effort, of ends: the error over that of uniform sampling with the same seed at the same
  /// effort, between two of its passes, geometric mean: below 1 it beats uniform. NaN for metrics
  /// in decibels, for rays where nothing is traced, and where uniform took fewer seconds.
  std::array<Interval, 3> against_uniform = {};
};

double effort_of(Effort effort, const SweepPoint& point);

/// A lane at fixed thresholds, over its passes.
struct SweepLine {
  SweepLane lane;
  std::vector<SweepPoint> points;  ///< by rising passes: those that all seeds have, and the end

  const SweepPoint& end() const { return points.back(); }
};

/// What part a line has in the comparison, so that nobody takes a bound or a baseline for a method:
/// "method", "unbiased twin, pilot charged", "bound, knows the truth", "baseline", ….
std::string_view role_of(const SweepLane& lane);
bool is_method(const SweepLane& lane);

/// The lines of a sweep with their trajectories, in the plan's first metric.
std::vector<SweepLine> sweep_lines(const SweepResult& result, const SweepPlan& plan);
/// The baseline: at the passes at which all seeds were measured.
SweepLine uniform_line(const SweepResult& result, const SweepPlan& plan);

/// The ends of all lines in any of the plan's metrics, in the order of sweep_lanes().
std::vector<SweepPoint> sweep_ends(const SweepResult& result, const SweepPlan& plan,
                                   std::size_t metric);

/// Points that no other beats in both effort and error, by rising effort: the Pareto front.
/// `higher_is_better` speaks of the error.
std::vector<SweepPoint> pareto_front(std::vector<SweepPoint> points, Effort effort,
                                     bool higher_is_better);

/// What a sweep's table, files and charts show, worked out once.
struct SweepSummary {
  std::vector<SweepLine> lines;
  SweepLine uniform;
  /// By metric of the plan: the end of each line, in the order of `lines`.
  std::vector<std::vector<SweepPoint>> ends;
  MetricId metric = default_metric;
  const Metric* parts_metric = nullptr;  ///< of all SweepPoint::parts; null: there are none
  std::uint32_t seeds = 1;
  double noise_floor = 0.0;  ///< of the reference, in `metric`; NaN: not known

  bool is_traced() const { return uniform.end().mean_rays > 0.0; }
  /// Rays, which are counted, so that what is called best is the same on every machine; samples
  /// where nothing is traced.
  Effort counted() const { return is_traced() ? Effort::rays : Effort::mean_spp; }
};
SweepSummary summarize(const SweepResult& result, const SweepPlan& plan, double noise_floor);

/// The front over the trajectories of all lines but the oracle's, which no method can follow, and
/// over that of uniform sampling.
std::vector<SweepPoint> front_of(const SweepSummary& summary, Effort effort);

}  // namespace quartet
