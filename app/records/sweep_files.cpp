#include "app/records/sweep_files.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/records/csv_field.h"
#include "app/records/run_record.h"
#include "app/records/sweep_json.h"
#include "renderer/measure/top_share.h"
#include "renderer/view/sweep_charts.h"
#include "ui/paper/chart_figure.h"

namespace quartet {
namespace {

std::string stop_text(const StopConditions& stop) {
  std::string text;
  const auto add = [&](const std::string& word) { text += (text.empty() ? "" : " or ") + word; };
  if (stop.passes) {
    add(fmt::format("{} passes", *stop.passes));
  }
  if (stop.spp) {
    add(fmt::format("{:g} mean spp", *stop.spp));
  }
  if (stop.rays) {
    add(fmt::format("{:g} mean rays a pixel", *stop.rays));
  }
  if (stop.seconds) {
    add(fmt::format("{:g} s", *stop.seconds));
  }
  if (stop.error) {
    add(fmt::format("{} {:g}", metric(stop.error->metric).id, stop.error->value));
  }
  return text;
}

ChartFigure figure_of(const SweepReport& report, std::string title) {
  const SweepPlan& plan = report.plan;
  ChartFigure figure;
  figure.title = report.run.scene->scene().name + " · " + std::move(title);
  figure.lines = {fmt::format("{}x{} · {} samples · each run ends after {} · mean of {} seed{}",
                              report.run.settings.width, report.run.settings.height,
                              sampler_row(report.run.settings.sampler).id, stop_text(plan.stop),
                              plan.seeds, plan.seeds == 1 ? "" : "s")};
  figure.footer = report.command_line;
  return figure;
}

/// Of many charts.
void make_small(ChartFigure& figure) {
  figure.columns = 4;
  figure.area_width = 300.0;
  figure.area_height = 230.0;
}

std::string metric_text(const SweepReport& report) {
  const Metric& row = metric(report.summary.metric);
  std::string text = fmt::format("{}: {}", row.label, row.definition);
  if (report.reference_spp > 0) {
    text +=
        fmt::format("; reference of {} spp, uniform, other random numbers", report.reference_spp);
  }
  return text;
}

/// Rows of what the seeds of a line say together, with one beginning.
class JointRows {
 public:
  JointRows(const SweepReport& report, const SweepLane& lane, const SweepPoint& point) {
    const double pixels = double(report.run.settings.width) * double(report.run.settings.height);
    head_ =
        fmt::format("{},{},{:.6f},{:.0f},{:.0f},{:.6f}", csv_lane(report.run, lane.settings, "all"),
                    point.pass > 0 ? std::to_string(point.pass) : "end", point.seconds,
                    point.mean_rays * pixels, point.mean_spp * pixels, point.mean_spp);
  }

  void number(std::string_view name, double value) {
    if (std::isfinite(value)) {
      rows_ += fmt::format("{},{},{:.9g}\n", head_, name, value);
    }
  }
  void interval(const std::string& name, const Interval& value) {
    number(name, value.mean);
    number(name + "_low", value.low);
    number(name + "_high", value.high);
  }
  const std::string& rows() const { return rows_; }

 private:
  std::string head_;
  std::string rows_;
};

std::string joint_rows(const SweepReport& report, const SweepLane& lane, const SweepPoint& point) {
  const SweepSummary& summary = report.summary;
  JointRows rows(report, lane, point);
  rows.interval(std::string(metric(summary.metric).id), point.error);
  if (summary.parts_metric != nullptr) {
    rows.number(fmt::format("{}_squared_bias", summary.parts_metric->id), point.parts.squared_bias);
    rows.number(fmt::format("{}_variance", summary.parts_metric->id), point.parts.variance);
  }
  rows.interval("energy_error", point.energy);
  return rows.rows();
}

/// What ends have beside joint_rows().
std::string end_rows(const SweepReport& report, std::size_t line) {
  const SweepLine& from = report.summary.lines[line];
  JointRows rows(report, from.lane, from.end());
  for (const EffortRow& effort : efforts()) {
    rows.interval(fmt::format("{}_of_uniform_{}", metric(report.summary.metric).id, effort.id),
                  from.end().against_uniform[std::size_t(effort.key)]);
  }
  for (std::size_t m = 1; m < report.plan.metrics.size(); ++m) {
    rows.interval(std::string(metric(report.plan.metrics[m]).id),
                  report.summary.ends[m][line].error);
  }
  rows.number(top_share_id, from.end().relmse_top);
  return rows.rows();
}

}  // namespace

std::string sweep_csv(const SweepReport& report) {
  std::string csv(csv_header);
  const LaneSettings uniform = default_settings(EstimatorId::uniform);
  for (std::size_t k = 0; k < report.result.uniform.size(); ++k) {
    for (const Measurement& measurement : report.result.uniform[k]) {
      csv += csv_metric_rows(
          csv_measurement(report.run, uniform, report.result.first_seed + k, measurement),
          report.plan.metrics, measurement);
    }
  }
  for (const SweepRun& run : report.result.runs) {
    const LaneSettings& settings = run.lane.settings;
    for (const Measurement& pass : run.way) {
      csv += csv_metric_rows(csv_measurement(report.run, settings, run.seed, pass),
                             report.plan.metrics, pass);
    }
    const std::string head = csv_measurement(report.run, settings, run.seed, run.end);
    csv += csv_metric_rows(head, report.plan.metrics, run.end);
    for (const auto& [name, value] : {std::pair{"rank_correlation", run.quality.rank_correlation},
                                      {"false_stops", run.quality.stops.share()},
                                      {"oracle_distance", run.oracle_distance}}) {
      if (!std::isnan(value)) {
        csv += fmt::format("{},{},{:.6f}\n", head, name, value);
      }
    }
  }
  for (const SweepPoint& point : report.summary.uniform.points) {
    csv += joint_rows(report, report.summary.uniform.lane, point);
  }
  for (std::size_t i = 0; i < report.summary.lines.size(); ++i) {
    for (const SweepPoint& point : report.summary.lines[i].points) {
      csv += joint_rows(report, report.summary.lines[i].lane, point);
    }
    csv += end_rows(report, i);
  }
  return csv;
}

std::string calibration_csv(const SweepReport& report) {
  std::string csv =
      "scene,sampler,estimator,policy,mode,thresholds,seed,estimated_error,true_squared_error,"
      "pixels\n";
  for (const SweepRun& run : report.result.runs) {
    for (const CalibrationBin& bin : run.quality.calibration) {
      csv += fmt::format("{},{:.6g},{:.6g},{}\n", csv_lane(report.run, run.lane.settings, run.seed),
                         bin.estimated, bin.true_squared_error, bin.pixels);
    }
  }
  return csv;
}

void write_sweep_files(StagedFiles& files, const SweepReport& report) {
  files.write("sweep.csv", sweep_csv(report));
  files.write("sweep.json", sweep_json(report));
  files.write("calibration.csv", calibration_csv(report));
  ChartFigure sweep = figure_of(report, "adaptive sampling at the default thresholds");
  sweep.charts = overview_charts(report.summary, report.effort);
  sweep.lines.push_back(metric_text(report));
  sweep.lines.emplace_back(
      "A mark is a pass. Bias² is without its own noise, and may come out below 0: its line leaves "
      "at "
      "the bottom.");
  write_chart_files(files, "sweep", sweep);
  ChartFigure thresholds = figure_of(report, "each estimator at fixed thresholds");
  thresholds.charts = threshold_charts(report.summary, report.effort);
  make_small(thresholds);
  thresholds.lines.push_back(metric_text(report));
  thresholds.lines.emplace_back(
      "A line is a lane over its passes, its label the factor on the default thresholds; unbiased "
      "lanes are charged with their pilots.");
  write_chart_files(files, "thresholds", thresholds);
  ChartFigure calibration = figure_of(report, "what the error estimators know");
  calibration.charts = calibration_charts(report.result);
  make_small(calibration);
  calibration.lines.emplace_back(
      "At the default thresholds with the first seed; each mark is the mean of a 32nd of the "
      "pixels.");
  write_chart_files(files, "calibration", calibration);
}

}  // namespace quartet
