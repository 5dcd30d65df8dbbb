#include "renderer/study/sweep_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "renderer/measure/error_curve.h"

namespace quartet {
namespace {

constexpr double sweep_rate = 1.0 - sweep_confidence;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

template <class Number>
std::vector<double> numbers_of(std::span<const Measurement* const> seeds, const Number& number) {
  std::vector<double> numbers;
  numbers.reserve(seeds.size());
  for (const Measurement* seed : seeds) {
    numbers.push_back(number(*seed));
  }
  return numbers;
}

/// What all seeds say at one place of a line; `metric` of those that they were measured in.
SweepPoint point_of(std::span<const Measurement* const> seeds, std::size_t metric) {
  const auto mean = [&](const auto& number) { return mean_of(numbers_of(seeds, number)); };
  SweepPoint point;
  point.pass = seeds.front()->record.pass;
  for (const Measurement* seed : seeds) {
    point.pass = seed->record.pass == point.pass ? point.pass : 0;
  }
  point.seconds = mean([](const Measurement& m) { return m.record.seconds; });
  point.mean_spp = mean([](const Measurement& m) { return m.mean_spp; });
  point.mean_rays = mean([](const Measurement& m) { return m.mean_rays; });
  point.error = mean_interval(
      numbers_of(seeds, [&](const Measurement& m) { return m.values[metric]; }), sweep_rate);
  point.energy =
      mean_interval(numbers_of(seeds, [](const Measurement& m) { return m.energy; }), sweep_rate);
  point.relmse_top = mean([](const Measurement& m) { return m.relmse_top; });
  point.parts = {not_known, not_known};
  point.against_uniform.fill({not_known, not_known, not_known});
  return point;
}

/// The runs of a line, a seed each.
std::vector<const SweepRun*> runs_of(const SweepResult& result, std::size_t line) {
  const std::size_t a_seed = result.runs.size() / result.uniform.size();
  std::vector<const SweepRun*> runs;
  for (std::size_t k = 0; k < result.uniform.size(); ++k) {
    runs.push_back(&result.runs[k * a_seed + line]);
  }
  return runs;
}

/// Of one metric of a run.
ErrorCurve error_over(Effort effort, std::span<const Measurement> run, std::size_t metric) {
  std::vector<ErrorCurve::Point> points;
  for (const Measurement& measurement : run) {
    points.push_back({effort_of(effort, measurement), measurement.values[metric]});
  }
  return ErrorCurve(std::move(points));
}

Interval against_uniform(std::span<const SweepRun* const> runs, const SweepResult& result,
                         Effort effort, std::size_t metric) {
  std::vector<double> ratios;
  for (const SweepRun* run : runs) {
    const std::span baseline = result.uniform[std::size_t(run->seed - result.first_seed)];
    ratios.push_back(run->end.values[metric] /
                     error_over(effort, baseline, metric).error_at(effort_of(effort, run->end)));
  }
  return geometric_interval(ratios, sweep_rate);
}

SweepPoint end_of(const SweepResult& result, const SweepPlan& plan, std::size_t line,
                  std::size_t metric) {
  const std::vector<const SweepRun*> runs = runs_of(result, line);
  std::vector<const Measurement*> ends;
  std::ranges::transform(runs, std::back_inserter(ends), [](const SweepRun* r) { return &r->end; });
  SweepPoint point = point_of(ends, metric);
  if (quartet::metric(plan.metrics[metric]).scale != MetricScale::decibels) {
    for (const EffortRow& effort : efforts()) {
      point.against_uniform[std::size_t(effort.key)] =
          against_uniform(runs, result, effort.key, metric);
    }
  }
  return point;
}

/// A seed's measurement after a pass; null if there is none.
const Measurement* after_pass(std::span<const Measurement> run, std::uint32_t pass) {
  const auto found =
      std::ranges::find(run, pass, [](const Measurement& m) { return m.record.pass; });
  return found == run.end() ? nullptr : &*found;
}

/// The points that all seeds of a line were measured at, but for its end.
std::vector<SweepPoint> points_of(std::span<const std::span<const Measurement>> seeds,
                                  const SweepParts* parts) {
  std::vector<SweepPoint> points;
  for (const Measurement& first : seeds.front()) {
    std::vector<const Measurement*> same;
    for (const std::span<const Measurement>& run : seeds) {
      same.push_back(after_pass(run, first.record.pass));
    }
    if (std::ranges::find(same, nullptr) != same.end()) {
      continue;
    }
    points.push_back(point_of(same, 0));
    if (parts != nullptr) {
      const auto known = parts->way.find(first.record.pass);
      points.back().parts = known == parts->way.end() ? points.back().parts : known->second;
    }
  }
  return points;
}

}  // namespace

double effort_of(Effort effort, const SweepPoint& point) {
  switch (effort) {
    case Effort::seconds:
      return point.seconds;
    case Effort::rays:
      return point.mean_rays;
    case Effort::mean_spp:
      return point.mean_spp;
  }
  return 0.0;
}

std::string_view role_of(const SweepLane& lane) {
  switch (lane.settings.estimator) {
    case EstimatorId::uniform:
      return "baseline";
    case EstimatorId::uniform_clamp:
      return "baseline that loses light by design";
    case EstimatorId::oracle:
      return lane.twin ? "bound: knows the truth of its pilot" : "bound: knows the truth";
    default:
      return lane.twin ? "unbiased twin, its pilot charged" : "method";
  }
}

bool is_method(const SweepLane& lane) {
  return role_of(lane) == "method";
}

std::vector<SweepLine> sweep_lines(const SweepResult& result, const SweepPlan& plan) {
  std::vector<SweepLine> lines;
  for (const SweepLane& lane : sweep_lanes(plan)) {
    const std::size_t i = lines.size();
    const SweepParts* parts = result.parts.empty() ? nullptr : &result.parts[i];
    std::vector<std::span<const Measurement>> seeds;
    for (const SweepRun* run : runs_of(result, i)) {
      seeds.emplace_back(run->way);
    }
    SweepLine line{lane, points_of(seeds, parts)};
    line.points.push_back(end_of(result, plan, i, 0));
    if (parts != nullptr) {
      line.points.back().parts = parts->end;
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

SweepLine uniform_line(const SweepResult& result, const SweepPlan& plan) {
  std::vector<std::span<const Measurement>> seeds(result.uniform.begin(), result.uniform.end());
  SweepLine line{{.settings = default_settings(EstimatorId::uniform)},
                 points_of(seeds, parts_metric(plan) ? &result.uniform_parts : nullptr)};
  if (metric(plan.metrics.front()).scale != MetricScale::decibels) {
    for (SweepPoint& point : line.points) {
      point.against_uniform.fill({1.0, 1.0, 1.0});
    }
  }
  return line;
}

std::vector<SweepPoint> sweep_ends(const SweepResult& result, const SweepPlan& plan,
                                   std::size_t metric) {
  std::vector<SweepPoint> points;
  const std::size_t lines = result.runs.size() / result.uniform.size();
  for (std::size_t i = 0; i < lines; ++i) {
    points.push_back(end_of(result, plan, i, metric));
  }
  return points;
}

std::vector<SweepPoint> pareto_front(std::vector<SweepPoint> points, Effort effort,
                                     bool higher_is_better) {
  const auto badness = [&](const SweepPoint& p) {
    return higher_is_better ? -p.error.mean : p.error.mean;
  };
  std::ranges::sort(points, [&](const SweepPoint& a, const SweepPoint& b) {
    return std::pair(effort_of(effort, a), badness(a)) <
           std::pair(effort_of(effort, b), badness(b));
  });
  std::vector<SweepPoint> front;
  for (const SweepPoint& point : points) {
    if (front.empty() || badness(point) < badness(front.back())) {
      front.push_back(point);
    }
  }
  return front;
}

SweepSummary summarize(const SweepResult& result, const SweepPlan& plan, double noise_floor) {
  SweepSummary summary;
  summary.lines = sweep_lines(result, plan);
  summary.uniform = uniform_line(result, plan);
  for (std::size_t m = 0; m < plan.metrics.size(); ++m) {
    summary.ends.push_back(sweep_ends(result, plan, m));
  }
  summary.metric = plan.metrics.front();
  summary.parts_metric = parts_metric(plan);
  summary.seeds = std::uint32_t(result.uniform.size());
  summary.noise_floor = noise_floor;
  return summary;
}

std::vector<SweepPoint> front_of(const SweepSummary& summary, Effort effort) {
  std::vector<SweepPoint> all = summary.uniform.points;
  for (const SweepLine& line : summary.lines) {
    if (line.lane.settings.estimator != EstimatorId::oracle) {
      all.insert(all.end(), line.points.begin(), line.points.end());
    }
  }
  return pareto_front(std::move(all), effort, metric(summary.metric).higher_is_better);
}

}  // namespace quartet
