#include "app/records/sweep_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/options/lane_option.h"
#include "app/records/json_text.h"
#include "renderer/measure/top_share.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

ordered_json point_json(const SweepReport& report, const SweepPoint& point) {
  ordered_json json;
  json["pass"] = point.pass > 0 ? ordered_json(point.pass) : ordered_json(nullptr);
  json["seconds"] = point.seconds;
  json["mean_rays"] = point.mean_rays;
  json["mean_spp"] = point.mean_spp;
  json["error"] = interval_json(point.error);
  json["energy_error"] = interval_json(point.energy);
  if (report.summary.parts_metric != nullptr) {
    json["squared_bias"] = point.parts.squared_bias;
    json["variance"] = point.parts.variance;
  }
  return json;
}

ordered_json line_json(const SweepReport& report, const SweepLine& line) {
  ordered_json json;
  json["lane"] = lane_text(line.lane.settings);
  json["estimator"] = estimator(line.lane.settings.estimator).id;
  json["mode"] = sample_mode(line.lane.settings.mode).id;
  json["role"] = role_of(line.lane);
  json["factor"] = line.lane.factor;
  json["passes"] = ordered_json::array();
  for (const SweepPoint& point : line.points) {
    json["passes"].push_back(point_json(report, point));
  }
  return json;
}

ordered_json end_json(const SweepReport& report, std::size_t line) {
  const SweepPoint& end = report.summary.lines[line].end();
  ordered_json json;
  for (const EffortRow& effort : efforts()) {
    json["of_uniform"][std::string(effort.id)] =
        interval_json(end.against_uniform[std::size_t(effort.key)]);
  }
  for (std::size_t m = 0; m < report.plan.metrics.size(); ++m) {
    json["metrics"][std::string(metric(report.plan.metrics[m]).id)] =
        interval_json(report.summary.ends[m][line].error);
  }
  json["metrics"][std::string(top_share_id)] = end.relmse_top;
  return json;
}

}  // namespace

std::string sweep_json(const SweepReport& report) {
  const SweepSummary& summary = report.summary;
  ordered_json json;
  json["scene"] = report.run.scene->scene().name;
  json["width"] = report.run.settings.width;
  json["height"] = report.run.settings.height;
  json["sampler"] = sampler_row(report.run.settings.sampler).id;
  json["command_line"] = report.command_line;
  json["seeds"] = summary.seeds;
  json["confidence"] = sweep_confidence;
  json["metric"] = metric(summary.metric).id;
  json["parts_of"] = summary.parts_metric != nullptr ? ordered_json(summary.parts_metric->id)
                                                     : ordered_json(nullptr);
  json["noise_floor"] = summary.noise_floor;
  json["reference_spp"] = report.reference_spp;
  json["lanes"] = ordered_json::array({line_json(report, summary.uniform)});
  for (std::size_t i = 0; i < summary.lines.size(); ++i) {
    ordered_json line = line_json(report, summary.lines[i]);
    line["end"] = end_json(report, i);
    json["lanes"].push_back(std::move(line));
  }
  return json_text(json) + "\n";
}

}  // namespace quartet
