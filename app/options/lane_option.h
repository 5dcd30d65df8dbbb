#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/options/lane_settings_options.h"

namespace quartet {

/// Which lanes a command runs: estimators with their defaults, or each lane spelt out.
struct LaneOptions {
  std::vector<std::string> estimators{"contrast", "kl", "chi2", "hellinger"};
  std::vector<std::string> lanes;
};

void add_lane_options(CLI::App& command, LaneOptions& options);
/// The settings of all lanes, for a run that ends as the user said in `stop`. Throws UsageError, as
/// checked_settings does.
std::vector<LaneSettings> settings_of_lanes(const LaneOptions& options,
                                            const LaneSettingsOptions& all,
                                            const StopConditions& stop);

/// A lane as one word, "kl:0.005,multiplier=0.5", with all of its settings that count, so that
/// parse_lane reads back one that does the same.
std::string lane_text(const LaneSettings& settings);
/// `options` hold where the word says nothing. Throws UsageError.
LaneSettings parse_lane(const std::string& text, const LaneSettingsOptions& options);

}  // namespace quartet
