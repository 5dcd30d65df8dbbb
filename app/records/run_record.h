#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/options/run_options.h"
#include "renderer/measure/reference/reference.h"
#include "renderer/session/snapshot.h"
#include "renderer/study/experiment.h"

namespace quartet {

class SampleStore;

/// What a run was and what came of it, for files. All settings, so that the command line and this
/// reproduce every pixel. Snapshots know their scene and settings here.

/// What the run as a whole took.
struct RunCost {
  int threads = 0;
  const SampleStore* store = nullptr;
  const SampleStore* pilot_store = nullptr;  ///< null if no lane had a pilot run
};

/// Text attributes for the header of a lane's EXR.
/// `run` is that of the files that belong together; empty for a single one.
std::map<std::string, std::string> exr_attributes(const std::string& command_line,
                                                  const Snapshot& snapshot, std::size_t lane,
                                                  const std::string& run = "");

/// One JSON document: settings, the store if its cost is known, the reference if there is one, and
/// each lane with its history and its errors against the reference.
std::string json_record(const std::string& command_line, const Snapshot& snapshot,
                        const std::optional<RunCost>& cost, const Reference* reference = nullptr,
                        const std::string& run = "");

/// The first line of every long-form CSV.
inline constexpr std::string_view csv_header =
    "scene,sampler,estimator,policy,mode,thresholds,seed,pass,seconds,rays,samples,mean_spp,metric,"
    "value\n";
/// The thresholds that matter, separated by spaces: no comma inside a CSV field.
std::string thresholds_text(const LaneSettings& settings);

/// The fields of csv_header up to `seed`, and up to `mean_spp`.
std::string csv_lane(const Run& run, const LaneSettings& settings, std::uint64_t seed);
/// `seed` may be "all", of what all of them together say.
std::string csv_lane(const Run& run, const LaneSettings& settings, std::string_view seed);
std::string csv_measurement(const Run& run, const LaneSettings& settings, std::uint64_t seed,
                            const Measurement& measurement);
/// A row for each of the metrics that it was measured in, one behind relMSE for what of it sits in
/// the largest thousandth of the pixels, and one for its energy.
std::string csv_metric_rows(const std::string& head, std::span<const MetricId> metrics,
                            const Measurement& measurement);

/// Long form, one row a measurement: scene, sampler, estimator, policy, thresholds, seed, pass,
/// seconds, rays, samples, mean_spp, metric, value. Every pass of every lane; the errors against a
/// reference of its last one.
std::string csv_record(const Snapshot& snapshot);

}  // namespace quartet
