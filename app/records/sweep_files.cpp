#include "app/records/sweep_files.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/records/csv_field.h"
#include "app/records/run_record.h"
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
  figure.lines = {
      fmt::format("{}x{} · {} samples · each point: thresholds × a factor from {:g} to {:g}, after "
                  "{} · median of {} seed{}",
                  report.run.settings.width, report.run.settings.height,
                  sampler_row(report.run.settings.sampler).id, plan.low, plan.high,
                  stop_text(plan.stop), plan.seeds, plan.seeds == 1 ? "" : "s")};
  figure.footer = report.command_line;
  return figure;
}

void write_figure(StagedFiles& files, const std::string& name, const ChartFigure& figure) {
  write_chart_png(figure, files.stage(name + ".png"));
  write_chart_pdf(figure, files.stage(name + ".pdf"));
  write_chart_svg(figure, files.stage(name + ".svg"));
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
    const std::string head = csv_measurement(report.run, run.settings, run.seed, run.end);
    csv += csv_metric_rows(head, report.plan.metrics, run.end);
    for (const auto& [name, value] : {std::pair{"rank_correlation", run.quality.rank_correlation},
                                      {"false_stops", run.quality.stops.share()},
                                      {"oracle_distance", run.oracle_distance}}) {
      if (!std::isnan(value)) {
        csv += fmt::format("{},{},{:.6f}\n", head, name, value);
      }
    }
  }
  return csv;
}

std::string calibration_csv(const SweepReport& report) {
  std::string csv =
      "scene,sampler,estimator,policy,mode,thresholds,seed,estimated_error,true_squared_error,"
      "pixels\n";
  for (const SweepRun& run : report.result.runs) {
    for (const CalibrationBin& bin : run.quality.calibration) {
      csv += fmt::format("{},{:.6g},{:.6g},{}\n", csv_lane(report.run, run.settings, run.seed),
                         bin.estimated, bin.true_squared_error, bin.pixels);
    }
  }
  return csv;
}

void write_sweep_files(StagedFiles& files, const SweepReport& report) {
  files.write("sweep.csv", sweep_csv(report));
  files.write("calibration.csv", calibration_csv(report));
  const SweepSummary summary = summarize(report.result, report.plan, 0, report.noise_floor);
  ChartFigure sweep = figure_of(report, "error against cost of adaptive sampling");
  sweep.charts = sweep_charts(summary);
  if (report.reference_spp > 0) {
    sweep.lines.push_back(fmt::format("{}: {}; reference of {} spp, uniform, other random numbers",
                                      metric(summary.metric).label,
                                      metric(summary.metric).definition, report.reference_spp));
  }
  write_figure(files, "sweep", sweep);
  ChartFigure calibration = figure_of(report, "what the error estimators know");
  calibration.charts = {calibration_chart(report.result)};
  calibration.lines.emplace_back(
      "At the default thresholds with the first seed; each dot is the mean of a 32nd of the "
      "pixels.");
  write_figure(files, "calibration", calibration);
}

}  // namespace quartet
