#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "renderer/measure/stop_conditions.h"

namespace quartet {

/// When a command has sampled enough, as given.
struct StopOptions {
  std::optional<std::uint32_t> frames;
  std::optional<double> spp;
  std::optional<double> seconds;
  std::string error;
};

/// Adds --frames, --spp, --seconds and --error, which can be combined.
void add_stop_options(CLI::App& command, StopOptions& options);

/// The first condition met ends a lane; without any, the 15 frames of the 2021 report. Throws
/// UsageError for an error target that is none, or one without anything to compare with.
StopConditions stop_conditions(const StopOptions& options, bool has_reference);

}  // namespace quartet
