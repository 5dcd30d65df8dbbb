#include "renderer/study/versus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "renderer/measure/error_curve.h"

namespace quartet {
namespace {

StopConditions stop_at(Effort effort, double goal) {
  StopConditions stop;
  switch (effort) {
    case Effort::seconds:
      stop.seconds = goal;
      break;
    case Effort::rays:
      stop.rays = goal;
      break;
    case Effort::mean_spp:
      stop.spp = goal;
      break;
  }
  return stop;
}

ErrorCurve curve_of(const VersusRun& run, Effort effort, std::size_t metric) {
  std::vector<ErrorCurve::Point> points;
  points.reserve(run.passes.size());
  for (const Measurement& pass : run.passes) {
    points.push_back({effort_of(effort, pass), pass.values[metric]});
  }
  return ErrorCurve(std::move(points));
}

double energy_at(const VersusRun& run, Effort effort, double at) {
  const auto after = std::ranges::find_if(
      run.passes, [&](const Measurement& pass) { return effort_of(effort, pass) >= at; });
  if (after == run.passes.begin() || after == run.passes.end()) {
    return after == run.passes.end() ? run.passes.back().energy : after->energy;
  }
  const double begin = effort_of(effort, *(after - 1));
  const double share = (at - begin) / (effort_of(effort, *after) - begin);
  return std::lerp((after - 1)->energy, after->energy, share);
}

/// Where both lanes were measured: from the later of their first passes to the earlier end.
std::pair<double, double> common_efforts(const VersusSeed& seed, Effort effort) {
  double first = 0.0;
  double last = std::numeric_limits<double>::infinity();
  for (const VersusRun& run : seed.runs) {
    first = std::max(first, effort_of(effort, run.passes.front()));
    last = std::min(last, effort_of(effort, run.passes.back()));
  }
  return {first, last};
}

/// Fills in what is known once both lanes have run.
void compare(const VersusPlan& plan, double goal, VersusSeed& seed) {
  const auto [first, last] = common_efforts(seed, plan.effort);
  seed.effort = std::max(first, std::min(last, goal));
  for (VersusRun& run : seed.runs) {
    for (std::size_t m = 0; m < plan.metrics.size(); ++m) {
      // One that was done before the other's first pass has its last error for ever.
      const double at = std::min(seed.effort, effort_of(plan.effort, run.passes.back()));
      run.errors.push_back(curve_of(run, plan.effort, m).error_at(at));
    }
    run.energy = energy_at(run, plan.effort, seed.effort);
  }
}

}  // namespace

std::optional<VersusResult> run_versus(
    const SampleWorld& world, const VersusPlan& plan, std::stop_token stop,
    const std::function<void(double, std::string_view)>& progress) {
  VersusResult result;
  std::array<ErrorSums, 2> sums;
  for (std::uint32_t k = 0; k < plan.seeds; ++k) {
    const std::uint64_t seed = world.first_seed + k;
    Experiment experiment = make_experiment(world, seed);
    VersusSeed measured;
    // A first pass may take more than the goal; the other lane then goes as far.
    double goal = plan.goal;
    for (const LaneSettings& settings : plan.lanes) {
      const auto first = experiment.run({.settings = settings, .stop = {.passes = 1}}, stop);
      if (!first) {
        return std::nullopt;
      }
      goal = std::max(goal, effort_of(plan.effort, first->back()));
    }
    for (std::size_t lane = 0; lane < plan.lanes.size(); ++lane) {
      const RunPlan run{.settings = plan.lanes[lane],
                        .stop = stop_at(plan.effort, goal),
                        .metrics = plan.metrics,
                        .measure_at = MeasureAt::every_pass};
      auto passes = experiment.run(run, stop, [&](double done) {
        if (progress) {
          const double runs = 2.0 * k + double(lane) + done;
          progress(runs / (2.0 * plan.seeds), fmt::format("seed {}", seed));
        }
      });
      if (!passes) {
        return std::nullopt;
      }
      measured.runs[lane].passes = std::move(*passes);
      sums[lane].add(
          metric(MetricId::mse).errors(experiment.lane().film().image(), *world.reference));
      keep_most(result.rejected, rejected_of(experiment.lane(), seed));
      keep_most(result.capped, capped_pixels(experiment.lane()));
    }
    result.partial |= experiment.store().partial();
    compare(plan, goal, measured);
    result.seeds.push_back(std::move(measured));
  }
  for (std::size_t lane = 0; lane < sums.size(); ++lane) {
    result.parts[lane] = sums[lane].parts();
  }
  return result;
}

std::vector<double> over_seeds(const VersusResult& result,
                               const std::function<double(const VersusSeed&)>& number) {
  std::vector<double> numbers;
  numbers.reserve(result.seeds.size());
  std::ranges::transform(result.seeds, std::back_inserter(numbers), number);
  return numbers;
}

Interval error_ratio(const VersusResult& result, std::size_t metric, double p) {
  const auto ratio = [&](const VersusSeed& seed) {
    return seed.runs[0].errors[metric] / seed.runs[1].errors[metric];
  };
  return geometric_interval(over_seeds(result, ratio), p);
}

Interval energy_of(const VersusResult& result, std::size_t lane, double p) {
  return mean_interval(
      over_seeds(result, [&](const VersusSeed& seed) { return seed.runs[lane].energy; }), p);
}

std::optional<double> crossing(const VersusResult& result, const VersusPlan& plan,
                               std::size_t metric) {
  double first = 0.0;
  double last = std::numeric_limits<double>::infinity();
  for (const VersusSeed& seed : result.seeds) {
    const auto [from, to] = common_efforts(seed, plan.effort);
    first = std::max(first, from);
    last = std::min(last, to);
  }
  std::vector<std::array<ErrorCurve, 2>> curves;
  for (const VersusSeed& seed : result.seeds) {
    curves.push_back(
        {curve_of(seed.runs[0], plan.effort, metric), curve_of(seed.runs[1], plan.effort, metric)});
  }
  // The sum over the seeds of the logarithm of the ratio.
  const auto lead = [&](double effort) {
    double sum = 0.0;
    for (const auto& [a, b] : curves) {
      sum += std::log(a.error_at(effort) / b.error_at(effort));
    }
    return sum;
  };
  constexpr int steps = 256;
  const auto effort_at = [&](int step) {
    return step == steps ? last : first * std::pow(last / first, double(step) / steps);
  };
  std::optional<double> crossed;
  for (int step = 0; first < last && step < steps; ++step) {
    const double a = lead(effort_at(step));
    const double b = lead(effort_at(step + 1));
    // Not where they begin alike.
    if (a * b < 0.0) {
      const double share = a / (a - b);
      crossed = effort_at(step) * std::pow(effort_at(step + 1) / effort_at(step), share);
    }
  }
  return crossed;
}

}  // namespace quartet
