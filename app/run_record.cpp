#include "app/run_record.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "renderer/version.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

std::string thresholds_text(const SamplingPolicy& policy) {
  std::string text;
  for (int c = 0; c < estimator(policy.estimator).channels; ++c) {
    text += fmt::format("{}{}", c > 0 ? " " : "", policy.thresholds[std::size_t(c)]);
  }
  return text;
}

/// The depth as Mitsuba writes it.
int depth_number(int max_depth) {
  return max_depth == std::numeric_limits<int>::max() ? -1 : max_depth;
}

double mean_spp(const Lane& lane, const FrameRecord& record) {
  return double(record.samples) / double(lane.film().size());
}

ordered_json policy_json(const SamplingPolicy& policy) {
  const Estimator& row = estimator(policy.estimator);
  ordered_json json;
  json["estimator"] = row.id;
  json["thresholds"] =
      std::vector<float>(policy.thresholds.begin(), policy.thresholds.begin() + row.channels);
  json["unit"] = row.unit;
  json["policy"] = allocation(policy.allocation.kind).id;
  json["multiplier"] = policy.allocation.multiplier;
  json["stochastic_rounding"] = policy.allocation.stochastic_rounding;
  json["max_spp"] = policy.max_spp;
  return json;
}

ordered_json settings_json(const Run& run) {
  ordered_json json;
  json["width"] = run.settings.width;
  json["height"] = run.settings.height;
  json["integrator"] = integrator(run.settings.integrator).id;
  json["max_depth"] = depth_number(run.settings.max_depth);
  json["seed"] = run.settings.seed;
  json["filter"] = "box";
  return json;
}

}  // namespace

std::map<std::string, std::string> exr_attributes(const Program& program, const Run& run,
                                                  const Lane& lane) {
  ordered_json settings = settings_json(run);
  settings["policy"] = policy_json(lane.policy());
  settings["frames"] = lane.frame();
  std::map<std::string, std::string> attributes{
      {"scene", run.scene->scene().name},
      {"settings", settings.dump()},
      {"seed", std::to_string(run.settings.seed)},
      {"version", std::string(version())},
      {"commandLine", program.command_line},
      {"varianceMeaning", "Variance.*: unbiased estimate of the variance of the pixel mean"},
  };
  if (!lane.history().empty()) {
    attributes["seconds"] = fmt::format("{:.6g}", lane.history().back().seconds);
    attributes["samples"] = std::to_string(lane.history().back().samples);
  }
  return attributes;
}

std::string json_record(const Program& program, const Run& run, const Lab& lab) {
  ordered_json json;
  json["program"] = "quartet";
  json["version"] = version();
  json["command_line"] = program.command_line;
  json["scene"] = run.scene->scene().name;
  json["scene_file"] = run.scene->scene().path.string();
  json["warnings"] = run.scene->scene().warnings;
  json["settings"] = settings_json(run);
  json["threads"] = run.lab.threads;
  const SampleStore& store = lab.store();
  json["store"] = {{"samples_traced", store.traced()},
                   {"samples_stored", store.stored()},
                   {"bytes", store.bytes()},
                   {"seconds", store.seconds()},
                   {"partial", store.partial()}};
  json["lanes"] = ordered_json::array();
  for (const Lane& lane : lab.lanes()) {
    ordered_json entry = policy_json(lane.policy());
    entry["rejected"] = lane.film().total_rejected();
    entry["history"] = ordered_json::array();
    for (const FrameRecord& record : lane.history()) {
      entry["history"].push_back({{"frame", record.frame},
                                  {"samples", record.samples},
                                  {"mean_spp", mean_spp(lane, record)},
                                  {"max_spp", record.max_spp},
                                  {"refined_pixels", record.refined},
                                  {"seconds", record.seconds}});
    }
    json["lanes"].push_back(std::move(entry));
  }
  return json.dump(2) + "\n";
}

std::string csv_record(const Run& run, const Lab& lab) {
  std::string csv =
      "scene,estimator,policy,thresholds,seed,frame,seconds,samples,mean_spp,metric,value\n";
  for (const Lane& lane : lab.lanes()) {
    const SamplingPolicy& policy = lane.policy();
    for (const FrameRecord& record : lane.history()) {
      const std::string row =
          fmt::format("{},{},{},{},{},{},{:.6f},{},{:.6f}", run.scene->scene().name,
                      estimator(policy.estimator).id, allocation(policy.allocation.kind).id,
                      thresholds_text(policy), run.settings.seed, record.frame, record.seconds,
                      record.samples, mean_spp(lane, record));
      csv += fmt::format("{},max_spp,{}\n", row, record.max_spp);
      csv += fmt::format("{},refined_share,{:.6f}\n", row,
                         double(record.refined) / double(lane.film().size()));
    }
  }
  return csv;
}

}  // namespace quartet
