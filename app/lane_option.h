#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/run_options.h"
#include "renderer/image/views.h"

namespace quartet {

/// Which lanes a command runs: estimators with their defaults, or each lane spelt out.
struct LaneOptions {
  std::vector<std::string> estimators{"contrast", "kl", "chi2", "hellinger"};
  std::vector<std::string> lanes;
};

void add_lane_options(CLI::App& command, LaneOptions& options);
/// Throws UsageError.
std::vector<SamplingPolicy> policies_of(const LaneOptions& options, const RunOptions& run);

/// A lane as one word, "kl:0.005,multiplier=0.5", which policy_of_lane reads back exactly.
std::string lane_text(const SamplingPolicy& policy);
SamplingPolicy policy_of_lane(const std::string& text, const RunOptions& run);

/// How pictures are shown, as options.
struct ViewOptions {
  std::string heat = "linked";
  std::string tone_map = "clamp";
  float exposure = 0.0f;
};

void add_view_options(CLI::App& command, ViewOptions& options);
/// Throws UsageError, or std::invalid_argument for an unknown tone map.
ViewSettings view_settings(const ViewOptions& options);
std::string heat_id(HeatRange range);

}  // namespace quartet
