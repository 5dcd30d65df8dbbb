#include "renderer/view/sweep_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "renderer/base/number_text.h"
#include "renderer/view/estimator_look.h"

namespace quartet {
namespace {

constexpr Rgba8 sweep_floor_color{150, 60, 60};
constexpr Rgba8 front_color{222, 214, 190};
constexpr Rgba8 zero_color{150, 150, 150};
constexpr int ticks = 9;
constexpr int panel_ticks = 5;

struct Range {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void include(double value) {
    if (std::isfinite(value)) {
      min = std::min(min, value);
      max = std::max(max, value);
    }
  }
  bool empty() const { return !(min <= max); }
};

/// What is charted of a point; not finite: it is not there. Not above 0 on a logarithmic axis: the
/// line leaves the chart at the bottom.
using Quantity = std::function<double(const SweepPoint&)>;

double error_of(const SweepPoint& point) {
  return point.error.mean;
}

std::string with_unit(std::string_view label, const Metric& metric) {
  return fmt::format("{}{}{}", label, metric.unit.empty() ? "" : ", ", metric.unit);
}

std::string label_of(const SweepLane& lane) {
  std::string label(estimator(lane.settings.estimator).label);
  switch (lane.settings.estimator) {
    case EstimatorId::oracle:
      return label + ", knows the truth";
    case EstimatorId::uniform_clamp:
      return label + ", loses light";
    default:
      return label;
  }
}

bool is_default(const SweepLane& lane) {
  return lane.factor == 1.0;
}

/// A trajectory, as far as it can be charted.
Line trajectory(const SweepLine& from, Effort effort, const Quantity& quantity) {
  const EstimatorLook& look = look_of(from.lane.settings.estimator);
  Line line{.label = label_of(from.lane),
            .color = look.paper,
            .points = {},
            .dash = look.dash,
            .dots = true,
            .shape = look.shape,
            .label_at_end = true};
  // Where passes were measured for the sake of others, they say nothing of the line.
  constexpr std::size_t most_marks = 20;
  line.dots = from.points.size() <= most_marks;
  for (const SweepPoint& point : from.points) {
    const double value = quantity(point);
    if (effort_of(effort, point) > 0.0 && std::isfinite(value)) {
      line.points.emplace_back(effort_of(effort, point), value);
    }
  }
  return line;
}

/// The lines of the overview: uniform sampling first, below the others.
std::vector<const SweepLine*> overview_lines(const SweepSummary& summary) {
  std::vector<const SweepLine*> lines{&summary.uniform};
  for (const SweepLine& line : summary.lines) {
    if (is_default(line.lane) && !line.lane.twin) {
      lines.push_back(&line);
    }
  }
  return lines;
}

/// Where the lanes are; uniform sampling, which goes on as far as the dearest twin, is cut there.
/// The first passes of all are noise, and much of it: lines come in from the left.
Axis effort_axis(const std::vector<const SweepLine*>& lines, Effort effort, int wanted) {
  Range range;
  for (const SweepLine* line : lines) {
    if (line->lane.settings.estimator == EstimatorId::uniform && lines.size() > 1) {
      continue;
    }
    for (const SweepPoint& point : line->points) {
      range.include(effort_of(effort, point));
    }
  }
  constexpr double widest = 32.0;
  return log_axis(std::max(0.9 * range.min, range.max / widest), 1.1 * range.max,
                  std::string(effort_row(effort).label), wanted);
}

/// Over the points that lie inside of the other axis, and can lie on this one. `left_out`: the
/// label of a line that does not count; it may be empty.
Range seen_range(const Chart& chart, bool logarithmic, std::string_view left_out = "") {
  Range range;
  for (const Line& line : chart.lines) {
    if (!left_out.empty() && line.label == left_out) {
      continue;
    }
    for (const glm::dvec2& point : line.points) {
      const double position = axis_position(chart.x, point.x);
      if (position >= 0.0 && position <= 1.0 && (!logarithmic || point.y > 0.0)) {
        range.include(point.y);
      }
    }
  }
  return range;
}

void add_floor(const SweepSummary& summary, Chart& chart) {
  if (summary.noise_floor > 0.0) {
    chart.levels.push_back(
        {fmt::format("noise floor of the reference, {}", format_number(summary.noise_floor)),
         sweep_floor_color, summary.noise_floor});
  }
}

Axis value_axis(const Range& seen, std::string label, bool logarithmic, int wanted) {
  if (seen.empty()) {
    return logarithmic ? log_axis(0.1, 1.0, std::move(label), wanted)
                       : linear_axis(-1.0, 1.0, std::move(label), wanted);
  }
  return logarithmic ? log_axis(0.9 * seen.min, 1.1 * seen.max, std::move(label), wanted)
                     : linear_axis(seen.min, seen.max, std::move(label), wanted);
}

Chart overview(const SweepSummary& summary, Effort effort, std::string title, std::string label,
               bool logarithmic, const Quantity& quantity) {
  Chart chart;
  chart.title = std::move(title);
  const std::vector<const SweepLine*> lines = overview_lines(summary);
  chart.x = effort_axis(lines, effort, ticks);
  for (const SweepLine* line : lines) {
    chart.lines.push_back(trajectory(*line, effort, quantity));
  }
  chart.y = value_axis(seen_range(chart, logarithmic), std::move(label), logarithmic, ticks);
  return chart;
}

/// With the numbers at the ends. What is clamped is so dark that all others would lie on one line
/// if it were in the picture.
Chart energy_chart(const SweepSummary& summary, Effort effort) {
  const std::string label = "energy: mean luminance over the reference's, less 1, %";
  Chart chart = overview(summary, effort, "Light lost or gained", label, false,
                         [](const SweepPoint& p) { return 100.0 * p.energy.mean; });
  Range seen = seen_range(chart, false,
                          label_of({.settings = default_settings(EstimatorId::uniform_clamp)}));
  seen.include(0.0);
  const double margin = 0.05 * (seen.max - seen.min);
  chart.y = linear_axis(seen.min - margin, seen.max + margin, label, ticks);
  chart.levels.push_back({"", zero_color, 0.0});
  for (Line& line : chart.lines) {
    const auto last =
        std::find_if(line.points.rbegin(), line.points.rend(),
                     [&](const auto& point) { return axis_position(chart.x, point.x) <= 1.0; });
    if (last != line.points.rend()) {
      // Not −0.0.
      line.label += fmt::format(" {:+.1f} %", std::round(10.0 * last->y) / 10.0 + 0.0);
    }
  }
  return chart;
}

Line front_line(const SweepSummary& summary, Effort effort) {
  Line front{.label = "best of all that was measured, but for the oracle",
             .color = front_color,
             .points = {},
             .width = 5.0f};
  for (const SweepPoint& point : front_of(summary, effort)) {
    front.points.emplace_back(effort_of(effort, point), error_of(point));
  }
  return front;
}

std::string factor_text(const SweepLane& lane) {
  return fmt::format("× {:.2g}{}", lane.factor, lane.twin ? ", unbiased" : "");
}

Band interval_band(const SweepLine& from, Effort effort, std::uint32_t seeds) {
  Band band{.label = fmt::format("{:g} % interval over {} seeds", 100.0 * sweep_confidence, seeds),
            .color = look_of(from.lane.settings.estimator).paper,
            .lower = {},
            .upper = {}};
  band.color.a = 40;
  for (const SweepPoint& point : from.points) {
    band.lower.emplace_back(effort_of(effort, point), point.error.low);
    band.upper.emplace_back(effort_of(effort, point), point.error.high);
  }
  return band;
}

/// The lines of one estimator's small chart: its thresholds, with labels as many as can be read,
/// and its twin at the default ones.
void add_thresholds(const SweepSummary& summary, EstimatorId id, Effort effort, Chart& chart) {
  constexpr std::size_t readable = 9;
  std::vector<const SweepLine*> own;
  for (const SweepLine& line : summary.lines) {
    if (line.lane.settings.estimator == id && (!line.lane.twin || is_default(line.lane))) {
      own.push_back(&line);
    }
  }
  const std::size_t step = (own.size() + readable - 1) / readable;
  for (std::size_t i = 0; i < own.size(); ++i) {
    Line line = trajectory(*own[i], effort, error_of);
    const bool usual = is_default(own[i]->lane);
    if (usual && !own[i]->lane.twin && summary.seeds > 1) {
      chart.bands.push_back(interval_band(*own[i], effort, summary.seeds));
    }
    line.label = i % step == 0 || usual ? factor_text(own[i]->lane) : std::string();
    line.dash = own[i]->lane.twin ? Dash::dotted : Dash::solid;
    line.dots = usual;
    line.width = usual ? 1.2f : 0.6f;
    chart.lines.push_back(std::move(line));
  }
  if (own.size() == 1) {
    chart.lines.back().label.clear();  // nothing to tell apart
  }
}

}  // namespace

std::vector<Chart> overview_charts(const SweepSummary& summary, Effort effort) {
  const Metric& row = metric(summary.metric);
  const bool logarithmic = row.scale != MetricScale::decibels;
  std::vector<Chart> charts;
  charts.push_back(
      overview(summary, effort, "Error", with_unit(row.label, row), logarithmic, error_of));
  Chart& errors = charts.back();
  errors.lines.insert(errors.lines.begin(), front_line(summary, effort));
  // A noise floor far below all errors says that it is far below, wherever it is drawn.
  constexpr double far = 20.0;
  Range seen = seen_range(errors, logarithmic);
  if (logarithmic && summary.noise_floor > seen.min / far) {
    seen.include(summary.noise_floor);
  }
  errors.y = value_axis(seen, with_unit(row.label, row), logarithmic, ticks);
  add_floor(summary, errors);
  charts.push_back(energy_chart(summary, effort));
  if (summary.parts_metric == nullptr || summary.seeds < 2) {
    return charts;
  }
  const std::string of =
      with_unit(fmt::format("of {}", summary.parts_metric->label), *summary.parts_metric);
  charts.push_back(overview(summary, effort, "Bias²", of, true,
                            [](const SweepPoint& p) { return p.parts.squared_bias; }));
  charts.push_back(overview(summary, effort, "Variance", of, true,
                            [](const SweepPoint& p) { return p.parts.variance; }));
  // On one axis, so that the larger part is seen to be the larger one.
  // Bias² far below all variances is noise.
  constexpr double little = 0.1;
  Range both = seen_range(charts[2], true);
  const Range variances = seen_range(charts[3], true);
  both.include(variances.min);
  both.include(variances.max);
  both.min = std::max(both.min, little * variances.min);
  charts[2].y = charts[3].y = value_axis(both, of, true, ticks);
  if (summary.parts_metric->key == summary.metric) {
    add_floor(summary, charts[2]);
  }
  return charts;
}

std::vector<Chart> threshold_charts(const SweepSummary& summary, Effort effort) {
  const Metric& row = metric(summary.metric);
  const bool logarithmic = row.scale != MetricScale::decibels;
  std::vector<const SweepLine*> all{&summary.uniform};
  std::vector<EstimatorId> ids;
  for (const SweepLine& line : summary.lines) {
    all.push_back(&line);
    if (std::ranges::find(ids, line.lane.settings.estimator) == ids.end()) {
      ids.push_back(line.lane.settings.estimator);
    }
  }
  const Axis x = effort_axis(all, effort, panel_ticks);
  Line uniform = trajectory(summary.uniform, effort, error_of);
  uniform.dots = false;
  uniform.label_at_end = false;
  std::vector<Chart> charts;
  Range seen;
  for (const EstimatorId id : ids) {
    Chart chart;
    chart.title = label_of({.settings = default_settings(id)});
    chart.x = x;
    chart.lines = {front_line(summary, effort), uniform};
    add_thresholds(summary, id, effort, chart);
    const Range own = seen_range(chart, logarithmic);
    seen.include(own.min);
    seen.include(own.max);
    charts.push_back(std::move(chart));
  }
  for (Chart& chart : charts) {
    chart.y = value_axis(seen, with_unit(row.label, row), logarithmic, panel_ticks);
  }
  return charts;
}

std::vector<Chart> calibration_charts(const SweepResult& result) {
  std::vector<Chart> charts;
  Range x;
  Range y;
  for (const SweepRun& run : result.runs) {
    if (!is_default(run.lane) || run.lane.twin || run.seed != result.first_seed ||
        run.quality.calibration.empty()) {
      continue;
    }
    const EstimatorLook& look = look_of(run.lane.settings.estimator);
    Line line{.label = "", .color = look.paper, .points = {}, .dots = true, .shape = look.shape};
    for (const CalibrationBin& bin : run.quality.calibration) {
      if (bin.estimated > 0.0 && bin.true_squared_error > 0.0) {
        line.points.emplace_back(bin.estimated, bin.true_squared_error);
        x.include(bin.estimated);
        y.include(bin.true_squared_error);
      }
    }
    charts.emplace_back();
    charts.back().title = label_of(run.lane);
    charts.back().lines.push_back(std::move(line));
  }
  for (Chart& chart : charts) {
    chart.x = log_axis(x.min, x.max, "estimated error / threshold", panel_ticks);
    chart.y = log_axis(y.min, y.max, "true squared error, radiance²", panel_ticks);
  }
  return charts;
}

}  // namespace quartet
