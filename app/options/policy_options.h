#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/number_option.h"
#include "renderer/adaptive/policy.h"
#include "renderer/measure/stop_conditions.h"

namespace quartet {

/// What is said of policies, by the options of a command for all lanes, or in a --lane for that
/// one. What is not said is as the estimator or the policy has it.
struct PolicyOptions {
  std::string policy;
  std::string mode;
  std::optional<std::uint16_t> first_samples;
  std::optional<std::uint16_t> batch_samples;
  std::optional<float> multiplier;
  bool stochastic_rounding = false;
  std::optional<std::uint32_t> max_spp;
};

/// Of a threshold, by option or in a lane.
inline constexpr NumberRange<float> threshold_limits = above_zero<float>;

/// Adds all of them to a command.
void add_policy_options(CLI::App& command, PolicyOptions& options);

/// One row of the table of what can be said of a policy: what it is called, and which policies read
/// it.
struct PolicyParameter {
  std::string_view option;  ///< of a command
  std::string_view word;    ///< of a --lane
  bool takes_value;
  /// Which policies read it, for a message: "it is for the policy vote".
  std::string (*readers)();
  bool (*given)(const PolicyOptions& options);
  bool (*read_by)(const SamplingPolicy& policy);
  /// Gives the policy what the options say of it; throws std::invalid_argument for unknown ids.
  void (*put)(const PolicyOptions& options, SamplingPolicy& policy);
  /// Reads the value of a --lane's word; returns what is wrong with it, else an empty text.
  std::string (*read)(const std::string& value, PolicyOptions& options);
};

std::span<const PolicyParameter> policy_parameters();

/// A lane before it is checked: its policy, and what of it was said for it alone.
struct ChosenLane {
  SamplingPolicy policy;
  PolicyOptions own;
};

/// The policy of an estimator as the options want it; what the lane has of its own goes first.
/// What the policy does not read is left as it is.
SamplingPolicy policy_of(const PolicyOptions& options, EstimatorId estimator,
                         const PolicyOptions& own = {});

/// The policies of a run, which ends as the user said in `stop`: where that takes more samples than
/// a pixel has by default, and nothing is said of the most, they are let have them. Throws
/// UsageError for an option that no lane reads, and for one that contradicts another.
std::vector<SamplingPolicy> checked_policies(const PolicyOptions& options,
                                             std::span<const ChosenLane> lanes,
                                             const StopConditions& stop);

}  // namespace quartet
