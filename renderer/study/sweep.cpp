#include "renderer/study/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

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

/// Sums of the pictures of a line, seed by seed.
struct LineSums {
  std::map<std::uint32_t, ErrorSums> way;  // by pass
  ErrorSums end;

  /// Those of passes that a seed was not measured after, which nobody will ask for.
  void forget_incomplete(std::size_t seeds) {
    std::erase_if(way, [&](const auto& each) { return each.second.pictures() < seeds; });
  }
  SweepParts parts() const {
    SweepParts parts;
    for (const auto& [pass, sums] : way) {
      parts.way[pass] = sums.parts();
    }
    parts.end = end.parts();
    return parts;
  }
};

/// What a sweep adds up over its seeds.
struct SweepSums {
  const Metric* metric = nullptr;  // null: nothing
  bool on_the_way = true;          // not at ends alone
  std::vector<LineSums> lines;
  LineSums uniform;
};

/// Bytes that the sums of all lines take, about: each is measured after some ten passes, and
/// uniform sampling on both sides of each.
std::size_t bytes_of_sums(const Metric& metric, std::size_t lines, const RadianceImage& reference) {
  constexpr std::size_t passes = 12;
  return lines * passes * sizeof(float) * metric.errors(reference, reference).size();
}

/// Has a run's pictures added to those of its line.
void add_to(LineSums& line, const SweepSums& sums, const Experiment& experiment, RunPlan& run) {
  if (sums.metric != nullptr && sums.on_the_way) {
    run.each_picture = [&line, metric = sums.metric, &experiment](std::uint32_t pass,
                                                                  const RadianceImage& image) {
      line.way[pass].add(metric->errors(image, *experiment.reference()));
    };
  }
}

void add_end(LineSums& line, const SweepSums& sums, const Experiment& experiment) {
  if (sums.metric != nullptr) {
    line.end.add(sums.metric->errors(experiment.lane().film().image(), *experiment.reference()));
  }
}

/// What uniform sampling gives for what other runs took; nothing if stopped.
std::optional<std::vector<Measurement>> run_baseline(Experiment& experiment, const SweepPlan& plan,
                                                     std::span<const Measurement> ends,
                                                     std::span<const Measurement> first_seed,
                                                     std::stop_token stop, SweepSums& sums,
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
  add_to(sums.uniform, sums, experiment, run);
  return experiment.run(run, stop, tell);
}

std::vector<float> true_squared_error(const Experiment& experiment) {
  const ScalarImage map =
      metric(MetricId::mse).map(experiment.lane().film().image(), *experiment.reference());
  return {map.pixels().begin(), map.pixels().end()};
}

/// Passes that a trajectory is drawn through, beside powers of two.
std::vector<std::uint32_t> passes_between() {
  std::vector<std::uint32_t> passes;
  for (std::uint32_t pass = 3; pass < (1u << 20); pass *= 2) {
    passes.push_back(pass);
  }
  return passes;
}

std::string name_of(const SweepLane& lane) {
  return fmt::format("{}{} x {:.3g}", estimator(lane.settings.estimator).id,
                     lane.twin ? " unbiased" : "", lane.factor);
}

/// One seed's runs; false if stopped.
bool run_seed(Experiment& experiment, std::uint64_t seed, const SweepPlan& plan,
              std::stop_token stop, SweepProgress& progress, SweepSums& sums, SweepResult& result) {
  const auto tell = [&](double of_run) { progress.update(of_run); };
  const std::vector<SweepLane> lanes = sweep_lanes(plan);
  std::vector<Measurement> ends;
  const std::vector<float> oracle = oracle_weights(experiment.first_samples(oracle_spp));
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    progress.begin_run(i, fmt::format("seed {}, {}", seed, name_of(lanes[i])));
    SweepRun run{.lane = lanes[i], .seed = seed};
    RunPlan planned{.settings = run.lane.settings,
                    .stop = plan.stop,
                    .metrics = plan.metrics,
                    .metrics_on_the_way = 1,
                    .measure_at = MeasureAt::powers_of_two,
                    .also_at = passes_between()};
    add_to(sums.lines[i], sums, experiment, planned);
    auto measured = experiment.run(planned, stop, tell);
    if (!measured) {
      return false;
    }
    add_end(sums.lines[i], sums, experiment);
    run.end = measured->back();
    measured->pop_back();
    run.way = std::move(*measured);
    ends.push_back(run.end);
    keep_most(result.rejected, rejected_of(experiment.lane(), seed));
    keep_most(result.capped, capped_pixels(experiment.lane()));
    run.quality = quality_of(experiment.lane(), true_squared_error(experiment));
    run.oracle_distance = share_distance(experiment.lane().taken(), oracle);
    result.runs.push_back(std::move(run));
  }
  progress.begin_run(lanes.size(), fmt::format("seed {}, uniform", seed));
  const std::span<const Measurement> first_seed =
      result.uniform.empty() ? std::span<const Measurement>() : result.uniform.front();
  auto uniform = run_baseline(experiment, plan, ends, first_seed, stop, sums, tell);
  if (!uniform) {
    return false;
  }
  result.uniform.push_back(std::move(*uniform));
  keep_most(result.rejected, rejected_of(experiment.lane(), seed));
  return true;
}

}  // namespace

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

std::vector<SweepLane> sweep_lanes(const SweepPlan& plan) {
  std::vector<SweepLane> lanes;
  for (const LaneSettings& settings : plan.lane_settings) {
    // Of a lane without thresholds there is nothing to scale, and nothing that a pilot decides.
    const bool decides = estimator(settings.estimator).channels > 0;
    const std::vector<double> factors = decides ? sweep_factors(plan) : std::vector{1.0};
    for (const double factor : factors) {
      lanes.push_back({scaled_thresholds(settings, factor), factor, false});
    }
    if (!decides || settings.mode == SampleMode::unbiased) {
      continue;
    }
    for (const double factor : factors) {
      if (plan.twins == Twins::at_all || (plan.twins == Twins::at_defaults && factor == 1.0)) {
        lanes.push_back({scaled_thresholds(settings, factor), factor, true});
        lanes.back().settings.mode = SampleMode::unbiased;
      }
    }
  }
  return lanes;
}

const Metric* parts_metric(const SweepPlan& plan) {
  for (const MetricId id : plan.metrics) {
    if (metric(id).errors != nullptr) {
      return &metric(id);
    }
  }
  return nullptr;
}

std::optional<SweepResult> run_sweep(
    const SampleWorld& world, const SweepPlan& plan, std::stop_token stop,
    const std::function<void(double, std::string_view)>& progress) {
  SweepResult result;
  result.first_seed = world.first_seed;
  SweepSums sums;
  sums.metric = parts_metric(plan);
  sums.lines.resize(sweep_lanes(plan).size());
  if (sums.metric != nullptr) {
    result.bytes_of_parts = bytes_of_sums(*sums.metric, sums.lines.size() + 1, *world.reference);
    sums.on_the_way = result.bytes_of_parts <= world.lab.memory;
    result.parts_at_ends_only = !sums.on_the_way;
  }
  SweepProgress told(std::size_t(plan.seeds), sums.lines.size() + 1, progress);
  for (std::uint32_t k = 0; k < plan.seeds; ++k) {
    told.begin_seed(k);
    const std::uint64_t seed = world.first_seed + k;
    // Each seed has a store of its own, gone with it: memory does not grow with seeds.
    Experiment experiment = make_experiment(world, seed);
    if (!run_seed(experiment, seed, plan, stop, told, sums, result)) {
      return std::nullopt;
    }
    std::ranges::for_each(sums.lines, [&](LineSums& line) { line.forget_incomplete(k + 1); });
    sums.uniform.forget_incomplete(k + 1);
    result.samples_traced += experiment.samples_traced();
    result.samples_used += experiment.samples_used();
    result.partial |= experiment.partial();
  }
  if (sums.metric != nullptr) {
    std::ranges::transform(sums.lines, std::back_inserter(result.parts), &LineSums::parts);
    result.uniform_parts = sums.uniform.parts();
  }
  return result;
}

}  // namespace quartet
