#pragma once

#include <map>
#include <string>

#include "app/commands.h"
#include "app/run_options.h"

namespace quartet {

/// What a run was and what came of it, for files. All settings, so that the command line and this
/// reproduce every pixel.

/// Text attributes for the header of a lane's EXR.
std::map<std::string, std::string> exr_attributes(const Program& program, const Run& run,
                                                  const Lane& lane);

/// One JSON document: settings, store, and each lane with its history.
std::string json_record(const Program& program, const Run& run, const Lab& lab);

/// Long form, one row a measurement: scene, estimator, policy, thresholds, seed, frame, seconds,
/// samples, mean_spp, metric, value. Every frame of every lane.
std::string csv_record(const Run& run, const Lab& lab);

}  // namespace quartet
