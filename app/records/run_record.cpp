#include "app/records/run_record.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "app/records/csv_field.h"
#include "app/records/json_text.h"
#include "app/records/vector_json.h"
#include "renderer/adaptive/effort.h"
#include "renderer/adaptive/policies/policy_parameter.h"
#include "renderer/base/version.h"
#include "renderer/measure/energy.h"
#include "renderer/measure/metrics.h"
#include "renderer/measure/reference/noise_floors.h"
#include "renderer/measure/top_share.h"
#include "renderer/trace/store/sample_store.h"
#include "renderer/view/views.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

/// The depth as Mitsuba writes it.
int depth_number(int max_depth) {
  return max_depth == std::numeric_limits<int>::max() ? -1 : max_depth;
}

ordered_json lane_settings_json(const LaneSettings& settings) {
  const Estimator& row = estimator(settings.estimator);
  ordered_json json;
  json["estimator"] = row.id;
  json["thresholds"] =
      std::vector<float>(settings.thresholds.begin(), settings.thresholds.begin() + row.channels);
  json["unit"] = row.unit;
  json["policy"] = policy(settings.policy.kind).id;
  json["mode"] = sample_mode(settings.mode).id;
  for (const PolicyParameter& parameter : policy_parameters()) {
    std::visit([&](const auto& value) { json[parameter.id] = settings.policy.*value.member; },
               parameter.value);
  }
  json["max_spp"] = settings.max_spp;
  return json;
}

ordered_json settings_json(const RenderSettings& settings) {
  ordered_json json;
  json["width"] = settings.width;
  json["height"] = settings.height;
  json["integrator"] = integrator(settings.integrator).id;
  json["sampler"] = sampler_row(settings.sampler).id;
  json["max_depth"] = depth_number(settings.max_depth);
  json["seed"] = settings.seed;
  json["camera"] = {{"origin", vector_json(settings.camera.origin)},
                    {"right", vector_json(settings.camera.right)},
                    {"up", vector_json(settings.camera.up)},
                    {"forward", vector_json(settings.camera.forward)}};
  json["filter"] = "box";
  return json;
}

/// Number by id: every metric of the lane's picture, and its efficiency; psnr may be infinite.
std::vector<std::pair<std::string_view, double>> true_errors(const Snapshot& snapshot,
                                                             std::size_t lane) {
  const RadianceImage image = radiance_image(snapshot, lane);
  std::vector<std::pair<std::string_view, double>> errors;
  for (const Metric& row : metrics()) {
    errors.emplace_back(row.id, row.compute(image, *snapshot.reference));
    if (row.key == MetricId::relmse) {
      errors.emplace_back(top_share_id, relmse_top_share(image, *snapshot.reference));
    }
  }
  const double mse = metric(MetricId::mse).compute(image, *snapshot.reference);
  errors.emplace_back("efficiency", efficiency(mse, snapshot.lanes[lane].history.back().seconds));
  errors.emplace_back("energy_error", energy_error(image, *snapshot.reference));
  return errors;
}

/// JSON has no infinity.
ordered_json number_json(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json store_json(const SampleStore& store) {
  return {{"samples_traced", store.traced()},
          {"samples_stored", store.stored()},
          {"bytes", store.bytes()},
          {"seconds", store.seconds()},
          {"partial", store.partial()}};
}

ordered_json reference_json(const Reference& reference) {
  ordered_json json;
  json["file"] = reference.path.string();
  if (!reference.layer.empty()) {
    json["layer"] = reference.layer;
  }
  json["spp"] = reference.ours() ? ordered_json(reference.spp) : ordered_json(nullptr);
  json["sampler"] = reference.ours() ? ordered_json(sampler_row(reference.settings.sampler).id)
                                     : ordered_json(nullptr);
  NoiseFloors floors(reference);
  for (const Metric& row : metrics()) {
    json["noise_floor"][row.id] = number_json(floors.of(row));
  }
  return json;
}

}  // namespace

std::map<std::string, std::string> exr_attributes(const std::string& command_line,
                                                  const Snapshot& snapshot, std::size_t lane,
                                                  const std::string& run) {
  const LaneSnapshot& shown = snapshot.lanes[lane];
  const SamplerRow& sampler = sampler_row(snapshot.settings.sampler);
  ordered_json settings = settings_json(snapshot.settings);
  settings["lane"] = lane_settings_json(shown.settings);
  settings["passes"] = shown.history.empty() ? 0 : shown.history.back().pass;
  std::map<std::string, std::string> attributes{
      {"scene", snapshot.scene->scene().name},
      {"settings", settings.dump()},
      {"seed", std::to_string(snapshot.settings.seed)},
      {"version", std::string(version())},
      {"commandLine", command_line},
      {"mode", std::string(sample_mode(shown.settings.mode).id)},
      {"sampler", std::string(sampler.id)},
      {"varianceMeaning", fmt::format("{}.*: {}", sampler.variance_channel, sampler.variance)},
  };
  if (!run.empty()) {
    attributes["run"] = run;
  }
  if (!shown.history.empty()) {
    attributes["seconds"] = fmt::format("{:.6g}", shown.history.back().seconds);
    attributes["rays"] = std::to_string(shown.history.back().rays);
    attributes["samples"] = std::to_string(shown.history.back().samples);
    attributes["pilotSamples"] = std::to_string(shown.history.back().pilot_samples);
  }
  return attributes;
}

std::string json_record(const std::string& command_line, const Snapshot& snapshot,
                        const std::optional<RunCost>& cost, const Reference* reference,
                        const std::string& run) {
  const Scene& scene = snapshot.scene->scene();
  ordered_json json;
  json["program"] = "quartet";
  json["version"] = version();
  json["command_line"] = command_line;
  if (!run.empty()) {
    json["run"] = run;
  }
  json["scene"] = scene.name;
  json["scene_file"] = scene.path.string();
  json["warnings"] = scene.warnings;
  json["settings"] = settings_json(snapshot.settings);
  if (cost) {
    json["threads"] = cost->threads;
    json["store"] = store_json(*cost->store);
    if (cost->pilot_store != nullptr) {
      json["pilot_store"] = store_json(*cost->pilot_store);
    }
  }
  if (reference != nullptr) {
    json["reference"] = reference_json(*reference);
  }
  json["lanes"] = ordered_json::array();
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    const LaneSnapshot& lane = snapshot.lanes[i];
    ordered_json entry = lane_settings_json(lane.settings);
    entry["rejected"] =
        std::accumulate(lane.rejected.begin(), lane.rejected.end(), std::uint64_t(0));
    entry["history"] = ordered_json::array();
    for (const PassRecord& record : lane.history) {
      entry["history"].push_back({{"pass", record.pass},
                                  {"samples", record.samples},
                                  {"pilot_samples", record.pilot_samples},
                                  {"mean_spp", mean_spp(record, snapshot.pixels())},
                                  {"max_spp", record.max_spp},
                                  {"pixels_not_done", record.not_done},
                                  {"rays", record.rays},
                                  {"seconds", record.seconds}});
    }
    if (snapshot.reference && !lane.history.empty()) {
      for (const auto& [id, error] : true_errors(snapshot, i)) {
        entry["metrics"][id] = number_json(error);
      }
    }
    json["lanes"].push_back(std::move(entry));
  }
  return json_text(json) + "\n";
}

std::string thresholds_text(const LaneSettings& settings) {
  std::string text;
  for (int c = 0; c < estimator(settings.estimator).channels; ++c) {
    text += fmt::format("{}{}", c > 0 ? " " : "", settings.thresholds[std::size_t(c)]);
  }
  return text;
}

std::string csv_lane(const Run& run, const LaneSettings& settings, std::uint64_t seed) {
  return csv_lane(run, settings, std::to_string(seed));
}

std::string csv_lane(const Run& run, const LaneSettings& settings, std::string_view seed) {
  return fmt::format("{},{},{},{},{},{},{}", csv_field(run.scene->scene().name),
                     sampler_row(run.settings.sampler).id, estimator(settings.estimator).id,
                     policy(settings.policy.kind).id, sample_mode(settings.mode).id,
                     thresholds_text(settings), seed);
}

std::string csv_measurement(const Run& run, const LaneSettings& settings, std::uint64_t seed,
                            const Measurement& measurement) {
  const PassRecord& record = measurement.record;
  return fmt::format("{},{},{:.6f},{},{},{:.6f}", csv_lane(run, settings, seed), record.pass,
                     record.seconds, record.rays, record.samples, measurement.mean_spp);
}

std::string csv_metric_rows(const std::string& head, std::span<const MetricId> metrics,
                            const Measurement& measurement) {
  std::string csv;
  for (std::size_t m = 0; m < measurement.values.size(); ++m) {
    csv += fmt::format("{},{},{:.9g}\n", head, metric(metrics[m]).id, measurement.values[m]);
    if (metrics[m] == MetricId::relmse && !std::isnan(measurement.relmse_top)) {
      csv += fmt::format("{},{},{:.6f}\n", head, top_share_id, measurement.relmse_top);
    }
  }
  return csv + fmt::format("{},energy_error,{:.9g}\n", head, measurement.energy);
}

std::string csv_record(const Snapshot& snapshot) {
  std::string csv(csv_header);
  const std::string scene = fmt::format("{},{}", csv_field(snapshot.scene->scene().name),
                                        sampler_row(snapshot.settings.sampler).id);
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    const LaneSnapshot& lane = snapshot.lanes[i];
    const LaneSettings& settings = lane.settings;
    std::string row;
    for (const PassRecord& record : lane.history) {
      row = fmt::format("{},{},{},{},{},{},{},{:.6f},{},{},{:.6f}", scene,
                        estimator(settings.estimator).id, policy(settings.policy.kind).id,
                        sample_mode(settings.mode).id, thresholds_text(settings),
                        snapshot.settings.seed, record.pass, record.seconds, record.rays,
                        record.samples, mean_spp(record, snapshot.pixels()));
      csv += fmt::format("{},max_spp,{}\n", row, record.max_spp);
      csv += fmt::format("{},pilot_samples,{}\n", row, record.pilot_samples);
      csv += fmt::format("{},share_not_done,{:.6f}\n", row,
                         double(record.not_done) / double(snapshot.pixels()));
    }
    if (snapshot.reference && !lane.history.empty()) {
      for (const auto& [id, error] : true_errors(snapshot, i)) {
        csv += fmt::format("{},{},{:.9g}\n", row, id, error);
      }
    }
  }
  return csv;
}

}  // namespace quartet
