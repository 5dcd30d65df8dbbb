#include "renderer/study/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/base/interval.h"
#include "renderer/base/stopwatch.h"
#include "renderer/study/calibrate.h"

namespace quartet {
namespace {

constexpr std::uint32_t oracle_spp = 64;

/// Tells how much of a sweep is done. The first runs of a seed trace most of its samples and take
/// most of its time; how much, the first seed tells all others.
class SweepProgress {
 public:
  SweepProgress(std::size_t seeds, std::size_t runs,
                const std::function<void(double, std::string_view)>& tell)
      : seeds_(double(seeds)), shares_(runs), tell_(tell) {
    for (std::size_t i = 0; i < runs; ++i) {
      shares_[i] = guess(double(i) / double(runs));
    }
  }

  void begin_seed(std::size_t seed) {
    if (seed == 1) {
      const double whole = elapsed();
      for (std::size_t i = 0; i < shares_.size(); ++i) {
        shares_[i] = whole > 0.0 ? starts_[i] / whole : shares_[i];
      }
    }
    seed_ = seed;
    watch_ = {};
  }
  void begin_run(std::size_t run, std::string what) {
    if (seed_ == 0) {
      starts_.push_back(elapsed());
    }
    run_ = run;
    what_ = std::move(what);
    update(0.0);
  }
  void update(double of_run) const {
    if (!tell_) {
      return;
    }
    const double begin = shares_[run_];
    const double end = run_ + 1 < shares_.size() ? shares_[run_ + 1] : 1.0;
    tell_((double(seed_) + begin + of_run * (end - begin)) / seeds_, what_);
  }

 private:
  static double guess(double share) { return std::pow(share, 0.3); }
  double elapsed() const { return watch_.seconds(); }

  double seeds_;
  std::vector<double> shares_;  // of a seed's time that is over when a run begins
  std::vector<double> starts_;  // seconds after the first seed's beginning
  const std::function<void(double, std::string_view)>& tell_;
  Stopwatch watch_;
  std::size_t seed_ = 0;
  std::size_t run_ = 0;
  std::string what_;
};

/// Passes of the baseline, and at which it is measured.
struct BaselinePlan {
  std::uint32_t passes = 1;
  std::vector<std::uint32_t> measured;  ///< rising
  bool reaches_all = true;              ///< that other runs took
};

/// Of a baseline whose passes are `passes`, so that it is measured just before and after it has
/// taken as many samples, or rays, as each of `ends`. Seconds decide nothing: they are never twice
/// the same. That they are reached too, a quarter more is run.
BaselinePlan baseline_plan(std::span<const Measurement> passes, std::span<const Measurement> ends) {
  BaselinePlan plan;
  for (const Measurement& end : ends) {
    for (const Effort effort : {Effort::rays, Effort::mean_spp}) {
      const auto reached = std::ranges::find_if(passes, [&](const Measurement& pass) {
        return effort_of(effort, pass) >= effort_of(effort, end);
      });
      plan.reaches_all &= reached != passes.end();
      const auto pass = std::uint32_t(reached - passes.begin()) + 1;
      plan.measured.push_back(std::max(pass, 2u) - 1);
      plan.measured.push_back(pass);
    }
  }
  std::ranges::sort(plan.measured);
  plan.measured.erase(std::unique(plan.measured.begin(), plan.measured.end()), plan.measured.end());
  const std::uint32_t last = plan.measured.empty() ? 1 : plan.measured.back();
  plan.passes = last + (last + 3) / 4;
  return plan;
}

/// What uniform sampling gives for what other runs took; nothing if stopped.
std::optional<std::vector<Measurement>> run_baseline(Experiment& experiment, const SweepPlan& plan,
                                                     std::span<const Measurement> ends,
                                                     std::span<const Measurement> first_seed,
                                                     std::stop_token stop,
                                                     const std::function<void(double)>& tell) {
  RunPlan run{.settings = default_settings(EstimatorId::uniform),
              .stop = {},
              .measure_at = MeasureAt::every_pass};
  run.settings.max_spp = most_spp;
  // A first run, of which only the costs are looked at, finds the passes.
  BaselinePlan found;
  found.reaches_all = false;
  for (std::uint32_t passes = 16; !found.reaches_all; passes *= 2) {
    run.stop.passes = passes;
    const auto measured = experiment.run(run, stop);
    if (!measured) {
      return std::nullopt;
    }
    found = baseline_plan(*measured, ends);
    if (measured->size() < passes) {
      break;  // no pixel may take more samples
    }
  }
  // All seeds are measured where the first was, so that a curve can be drawn of them.
  for (const Measurement& pass : first_seed) {
    found.measured.push_back(pass.record.pass);
    found.passes = std::max(found.passes, pass.record.pass);
  }
  std::ranges::sort(found.measured);
  run.stop.passes = found.passes;
  run.metrics = plan.metrics;
  run.measure_at = MeasureAt::powers_of_two;
  run.also_at = std::move(found.measured);
  return experiment.run(run, stop, tell);
}

std::vector<float> true_squared_error(const Experiment& experiment) {
  const ScalarImage map =
      metric(MetricId::mse).map(experiment.lane().film().image(), *experiment.reference());
  return {map.pixels().begin(), map.pixels().end()};
}

/// Of a lane without thresholds there is nothing to scale.
std::vector<double> lane_factors(const SweepPlan& plan, const LaneSettings& settings) {
  return estimator(settings.estimator).channels > 0 ? sweep_factors(plan) : std::vector{1.0};
}

/// One seed's runs; false if stopped.
bool run_seed(Experiment& experiment, std::uint64_t seed, const SweepPlan& plan,
              std::stop_token stop, SweepProgress& progress, SweepResult& result) {
  const auto tell = [&](double of_run) { progress.update(of_run); };
  std::size_t index = 0;
  std::vector<Measurement> ends;
  const std::vector<float> oracle = oracle_weights(experiment.first_samples(oracle_spp));
  for (const LaneSettings& settings : plan.lane_settings) {
    for (const double factor : lane_factors(plan, settings)) {
      progress.begin_run(index++, fmt::format("seed {}, {} x {:.3g}", seed,
                                              estimator(settings.estimator).id, factor));
      SweepRun run{.settings = scaled_thresholds(settings, factor), .factor = factor, .seed = seed};
      const auto measured = experiment.run(
          {.settings = run.settings, .stop = plan.stop, .metrics = plan.metrics}, stop, tell);
      if (!measured) {
        return false;
      }
      run.end = measured->back();
      ends.push_back(run.end);
      keep_most(result.rejected, rejected_of(experiment.lane(), seed));
      keep_most(result.capped, capped_pixels(experiment.lane()));
      run.quality = quality_of(experiment.lane(), true_squared_error(experiment));
      run.oracle_distance = share_distance(experiment.lane().taken(), oracle);
      result.runs.push_back(std::move(run));
    }
  }
  progress.begin_run(index, fmt::format("seed {}, uniform", seed));
  const std::span<const Measurement> first_seed =
      result.uniform.empty() ? std::span<const Measurement>() : result.uniform.front();
  auto uniform = run_baseline(experiment, plan, ends, first_seed, stop, tell);
  if (!uniform) {
    return false;
  }
  result.uniform.push_back(std::move(*uniform));
  keep_most(result.rejected, rejected_of(experiment.lane(), seed));
  return true;
}

/// The median of what each of some runs says.
template <class Runs, class Number>
double median_of(const Runs& runs, const Number& number) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const auto& run : runs) {
    values.push_back(number(run));
  }
  return median(std::move(values));
}

template <class Runs, class Number>
void set_error(SweepPoint& point, const Runs& runs, const Number& error) {
  point.error = median_of(runs, error);
  point.error_low = std::numeric_limits<double>::infinity();
  point.error_high = -point.error_low;
  for (const auto& run : runs) {
    point.error_low = std::min(point.error_low, error(run));
    point.error_high = std::max(point.error_high, error(run));
  }
}

/// Of one metric of a run.
ErrorCurve error_over(Effort effort, std::span<const Measurement> run, std::size_t metric) {
  std::vector<ErrorCurve::Point> points;
  for (const Measurement& measurement : run) {
    points.push_back({effort_of(effort, measurement), measurement.values[metric]});
  }
  return ErrorCurve(std::move(points));
}

/// SweepPoint::against_uniform of the runs of a point.
double against_uniform(std::span<const SweepRun> seeds, const SweepResult& result, Effort effort,
                       std::size_t metric) {
  return median_of(seeds, [&](const SweepRun& run) {
    const std::span baseline = result.uniform[std::size_t(run.seed - result.first_seed)];
    return run.end.values[metric] /
           error_over(effort, baseline, metric).error_at(effort_of(effort, run.end));
  });
}

}  // namespace

SampleWorld sample_world(std::shared_ptr<const TraceScene> scene, const RenderSettings& settings,
                         const LabOptions& lab, std::shared_ptr<const RadianceImage> reference) {
  SampleWorld world;
  world.first_seed = settings.seed;
  world.width = settings.width;
  world.height = settings.height;
  world.lab = lab;
  world.reference = std::move(reference);
  const auto seeded = [settings](std::uint64_t seed) {
    RenderSettings with_seed = settings;
    with_seed.seed = seed;
    return with_seed;
  };
  world.source = [scene, seeded](std::uint64_t seed) { return sample_source(scene, seeded(seed)); };
  world.pilot = [scene, seeded](std::uint64_t seed) { return pilot_source(scene, seeded(seed)); };
  return world;
}

LabOptions lab_options(const SampleWorld& world, std::uint64_t seed) {
  LabOptions options = world.lab;
  options.reference = world.reference;
  options.pilot_source = world.pilot ? world.pilot(seed) : SampleSource();
  return options;
}

Experiment make_experiment(const SampleWorld& world, std::uint64_t seed) {
  return {world.source(seed), world.width, world.height, lab_options(world, seed), world.reference};
}

std::vector<double> sweep_factors(const SweepPlan& plan) {
  std::vector<double> factors;
  const double step =
      plan.thresholds > 1 ? std::pow(plan.high / plan.low, 1.0 / double(plan.thresholds - 1)) : 1.0;
  bool has_default = false;
  for (int i = 0; i < plan.thresholds; ++i) {
    double factor = plan.low * std::pow(step, double(i));
    if (std::abs(std::log(factor)) < 1e-9) {
      factor = 1.0;
      has_default = true;
    }
    factors.push_back(factor);
  }
  if (!has_default) {
    factors.insert(std::ranges::lower_bound(factors, 1.0), 1.0);
  }
  return factors;
}

std::optional<SweepResult> run_sweep(
    const SampleWorld& world, const SweepPlan& plan, std::stop_token stop,
    const std::function<void(double, std::string_view)>& progress) {
  SweepResult result;
  result.first_seed = world.first_seed;
  std::size_t runs = 1;
  for (const LaneSettings& settings : plan.lane_settings) {
    runs += lane_factors(plan, settings).size();
  }
  SweepProgress told(std::size_t(plan.seeds), runs, progress);
  for (std::uint32_t k = 0; k < plan.seeds; ++k) {
    told.begin_seed(k);
    const std::uint64_t seed = world.first_seed + k;
    // Each seed has a store of its own, gone with it: memory does not grow with seeds.
    Experiment experiment = make_experiment(world, seed);
    if (!run_seed(experiment, seed, plan, stop, told, result)) {
      return std::nullopt;
    }
    result.samples_traced += experiment.store().traced();
    result.samples_used += experiment.samples_used();
    result.partial |= experiment.store().partial();
  }
  return result;
}

std::vector<SweepPoint> sweep_points(const SweepResult& result, const SweepPlan& plan,
                                     std::size_t metric) {
  const bool is_ratio = quartet::metric(plan.metrics[metric]).scale != MetricScale::decibels;
  const std::size_t a_seed = result.runs.size() / result.uniform.size();
  std::vector<SweepPoint> points;
  for (std::size_t i = 0; i < a_seed; ++i) {
    std::vector<SweepRun> seeds;
    for (std::size_t k = 0; k < result.uniform.size(); ++k) {
      seeds.push_back(result.runs[k * a_seed + i]);
    }
    SweepPoint point{.settings = seeds.front().settings, .factor = seeds.front().factor};
    point.seconds = median_of(seeds, [](const SweepRun& run) { return run.end.record.seconds; });
    point.mean_spp = median_of(seeds, [](const SweepRun& run) { return run.end.mean_spp; });
    point.mean_rays = median_of(seeds, [](const SweepRun& run) { return run.end.mean_rays; });
    set_error(point, seeds, [&](const SweepRun& run) { return run.end.values[metric]; });
    point.energy = median_of(seeds, [](const SweepRun& run) { return run.end.energy; });
    for (const EffortRow& effort : efforts()) {
      point.against_uniform[std::size_t(effort.key)] =
          is_ratio ? against_uniform(seeds, result, effort.key, metric)
                   : std::numeric_limits<double>::quiet_NaN();
    }
    points.push_back(point);
  }
  return points;
}

std::vector<SweepPoint> uniform_points(const SweepResult& result, std::size_t metric) {
  std::vector<SweepPoint> points;
  for (const Measurement& first : result.uniform.front()) {
    std::vector<Measurement> seeds;
    for (const std::vector<Measurement>& run : result.uniform) {
      const auto same = std::ranges::find(run, first.record.pass,
                                          [](const Measurement& m) { return m.record.pass; });
      if (same != run.end()) {
        seeds.push_back(*same);
      }
    }
    if (seeds.size() < result.uniform.size()) {
      continue;
    }
    SweepPoint point{.settings = default_settings(EstimatorId::uniform)};
    point.seconds = median_of(seeds, [](const Measurement& m) { return m.record.seconds; });
    point.mean_spp = median_of(seeds, [](const Measurement& m) { return m.mean_spp; });
    point.mean_rays = median_of(seeds, [](const Measurement& m) { return m.mean_rays; });
    set_error(point, seeds, [&](const Measurement& m) { return m.values[metric]; });
    point.energy = median_of(seeds, [](const Measurement& m) { return m.energy; });
    point.against_uniform.fill(1.0);
    points.push_back(point);
  }
  return points;
}

std::vector<SweepPoint> pareto_front(std::vector<SweepPoint> points, bool higher_is_better) {
  const auto badness = [&](const SweepPoint& p) { return higher_is_better ? -p.error : p.error; };
  std::ranges::sort(points, [&](const SweepPoint& a, const SweepPoint& b) {
    return std::pair(a.seconds, badness(a)) < std::pair(b.seconds, badness(b));
  });
  std::vector<SweepPoint> front;
  for (const SweepPoint& point : points) {
    if (front.empty() || badness(point) < badness(front.back())) {
      front.push_back(point);
    }
  }
  return front;
}

}  // namespace quartet
