#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "app/options/number_option.h"
#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/policy_parameter.h"
#include "renderer/measure/stop_conditions.h"

namespace quartet {

/// What is said of lane settings, by the options of a command for all lanes, or in a --lane for
/// that one. What is not said is as the estimator or the policy has it.
struct LaneSettingsOptions {
  std::string policy;
  std::string mode;
  std::set<PolicyParameterId> given;
  Policy parameters;  ///< those that are given
  std::optional<std::uint32_t> max_spp;
};

/// Of a threshold, by option or in a lane.
inline constexpr NumberRange<float> threshold_limits = above_zero<float>;

/// Adds all of them to a command.
void add_lane_settings_options(CLI::App& command, LaneSettingsOptions& options);

/// One of the settings that can be said of a lane: its policy, the parameters of policies, its
/// mode, and the most samples of a pixel.
struct LaneWord {
  std::string option;   ///< of a command: "--max-spp"
  std::string word;     ///< of a --lane: "max-spp"
  std::string value;    ///< stands for one in messages: "N"; empty if it takes none
  std::string readers;  ///< which policies read it, for a message: "it is for the policy vote"
  std::function<bool(const LaneSettingsOptions& options)> given;
  std::function<bool(const LaneSettings& settings)> read_by;
  /// Gives the settings what the options say of it; throws std::invalid_argument for unknown ids.
  std::function<void(const LaneSettingsOptions& options, LaneSettings& settings)> put;
  /// Reads the value of a --lane's word; returns what is wrong with it, else an empty text.
  std::function<std::string(const std::string& value, LaneSettingsOptions& options)> read;
  /// The value of settings that read it, where a --lane has to say it; else nothing.
  std::function<std::optional<std::string>(const LaneSettings& settings)> said_of;
  /// Adds the option to a command.
  std::function<void(CLI::App& command, LaneSettingsOptions& options)> add;
};

/// In the order in which they are offered; the policy, which decides what of the others is read,
/// is the first.
std::span<const LaneWord> lane_words();

/// A lane before it is checked: its settings, and what of it was said for it alone.
struct ChosenLane {
  LaneSettings settings;
  LaneSettingsOptions own;
};

/// Settings of an estimator as the options want them; what the lane has of its own goes first.
/// What the policy does not read is left as it is.
LaneSettings settings_of(const LaneSettingsOptions& options, EstimatorId estimator,
                         const LaneSettingsOptions& own = {});

/// The lanes of a run, which ends as the user said in `stop`: where that takes more samples than
/// a pixel has by default, and nothing is said of the most, they are let have them. Throws
/// UsageError for an option that no lane reads, and for one that contradicts another.
std::vector<LaneSettings> checked_settings(const LaneSettingsOptions& options,
                                           std::span<const ChosenLane> lanes,
                                           const StopConditions& stop);

}  // namespace quartet
