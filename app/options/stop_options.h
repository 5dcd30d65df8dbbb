#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/options/number_option.h"
#include "renderer/adaptive/lane_settings.h"
#include "renderer/measure/stop_conditions.h"
#include "renderer/scene/scene.h"

namespace quartet {

/// A mean of samples per pixel, which no pixel can have more of than most_spp.
inline constexpr NumberRange<double> spp_range{1e-30, double(most_spp)};

/// When a command has sampled enough, as given.
struct StopOptions {
  std::optional<std::uint32_t> passes;
  std::optional<double> spp;
  std::optional<double> rays;
  std::optional<double> seconds;
  std::string error;
};

/// Adds --passes, --spp, --rays, --seconds and --error, which can be combined.
void add_stop_options(CLI::App& command, StopOptions& options);

/// As the options say: the first condition met ends a lane. Throws UsageError for an error target
/// that is none, or one without anything to compare with.
StopConditions stop_conditions(const StopOptions& options, bool has_reference);

/// Throws UsageError if the condition of rays could never hold, because the scene's samples are
/// drawn and not traced.
void check_rays(const StopConditions& stop, const Scene& scene);

/// Without any condition, the 15 passes of the 2021 report.
StopConditions or_passes(StopConditions stop);

}  // namespace quartet
