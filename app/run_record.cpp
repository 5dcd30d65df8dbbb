#include "app/run_record.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "renderer/trace/sample_store.h"
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

double mean_spp(const Snapshot& snapshot, const FrameRecord& record) {
  return double(record.samples) / double(snapshot.pixels());
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

ordered_json vector_json(glm::vec3 v) {
  return ordered_json::array({v.x, v.y, v.z});
}

ordered_json settings_json(const RenderSettings& settings) {
  ordered_json json;
  json["width"] = settings.width;
  json["height"] = settings.height;
  json["integrator"] = integrator(settings.integrator).id;
  json["max_depth"] = depth_number(settings.max_depth);
  json["seed"] = settings.seed;
  json["camera"] = {{"origin", vector_json(settings.camera.origin)},
                    {"right", vector_json(settings.camera.right)},
                    {"up", vector_json(settings.camera.up)},
                    {"forward", vector_json(settings.camera.forward)}};
  json["filter"] = "box";
  return json;
}

}  // namespace

std::map<std::string, std::string> exr_attributes(const std::string& command_line,
                                                  const Snapshot& snapshot, std::size_t lane) {
  const LaneSnapshot& shown = snapshot.lanes[lane];
  ordered_json settings = settings_json(snapshot.settings);
  settings["policy"] = policy_json(shown.policy);
  settings["frames"] = snapshot.frame;
  std::map<std::string, std::string> attributes{
      {"scene", snapshot.scene->scene().name},
      {"settings", settings.dump()},
      {"seed", std::to_string(snapshot.settings.seed)},
      {"version", std::string(version())},
      {"commandLine", command_line},
      {"varianceMeaning", "Variance.*: unbiased estimate of the variance of the pixel mean"},
  };
  if (!shown.history.empty()) {
    attributes["seconds"] = fmt::format("{:.6g}", shown.history.back().seconds);
    attributes["samples"] = std::to_string(shown.history.back().samples);
  }
  return attributes;
}

std::string json_record(const std::string& command_line, const Snapshot& snapshot,
                        const std::optional<RunCost>& cost) {
  const Scene& scene = snapshot.scene->scene();
  ordered_json json;
  json["program"] = "quartet";
  json["version"] = version();
  json["command_line"] = command_line;
  json["scene"] = scene.name;
  json["scene_file"] = scene.path.string();
  json["warnings"] = scene.warnings;
  json["settings"] = settings_json(snapshot.settings);
  if (cost) {
    const SampleStore& store = *cost->store;
    json["threads"] = cost->threads;
    json["store"] = {{"samples_traced", store.traced()},
                     {"samples_stored", store.stored()},
                     {"bytes", store.bytes()},
                     {"seconds", store.seconds()},
                     {"partial", store.partial()}};
  }
  json["lanes"] = ordered_json::array();
  for (const LaneSnapshot& lane : snapshot.lanes) {
    ordered_json entry = policy_json(lane.policy);
    entry["rejected"] =
        std::accumulate(lane.rejected.begin(), lane.rejected.end(), std::uint64_t(0));
    entry["history"] = ordered_json::array();
    for (const FrameRecord& record : lane.history) {
      entry["history"].push_back({{"frame", record.frame},
                                  {"samples", record.samples},
                                  {"mean_spp", mean_spp(snapshot, record)},
                                  {"max_spp", record.max_spp},
                                  {"refined_pixels", record.refined},
                                  {"seconds", record.seconds}});
    }
    json["lanes"].push_back(std::move(entry));
  }
  return json.dump(2) + "\n";
}

std::string csv_record(const Snapshot& snapshot) {
  std::string csv =
      "scene,estimator,policy,thresholds,seed,frame,seconds,samples,mean_spp,metric,value\n";
  for (const LaneSnapshot& lane : snapshot.lanes) {
    const SamplingPolicy& policy = lane.policy;
    for (const FrameRecord& record : lane.history) {
      const std::string row =
          fmt::format("{},{},{},{},{},{},{:.6f},{},{:.6f}", snapshot.scene->scene().name,
                      estimator(policy.estimator).id, allocation(policy.allocation.kind).id,
                      thresholds_text(policy), snapshot.settings.seed, record.frame, record.seconds,
                      record.samples, mean_spp(snapshot, record));
      csv += fmt::format("{},max_spp,{}\n", row, record.max_spp);
      csv += fmt::format("{},refined_share,{:.6f}\n", row,
                         double(record.refined) / double(snapshot.pixels()));
    }
  }
  return csv;
}

}  // namespace quartet
