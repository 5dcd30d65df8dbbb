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
#include "renderer/adaptive/policy_parameter.h"
#include "renderer/measure/stop_conditions.h"

namespace quartet {

/// What is said of policies, by the options of a command for all lanes, or in a --lane for that
/// one. What is not said is as the estimator or the policy has it.
struct PolicyOptions {
  std::string policy;
  std::string mode;
  std::set<PolicyParameterId> given;
  Allocation parameters;  ///< those that are given
  std::optional<std::uint32_t> max_spp;
};

/// Of a threshold, by option or in a lane.
inline constexpr NumberRange<float> threshold_limits = above_zero<float>;

/// Adds all of them to a command.
void add_policy_options(CLI::App& command, PolicyOptions& options);

/// What can be said of a policy: the policy itself, its mode, the parameters of allocations, and
/// the most samples of a pixel.
struct PolicyWord {
  std::string option;   ///< of a command: "--max-spp"
  std::string word;     ///< of a --lane: "max-spp"
  std::string value;    ///< stands for one in messages: "N"; empty if it takes none
  std::string readers;  ///< which policies read it, for a message: "it is for the policy vote"
  std::function<bool(const PolicyOptions& options)> given;
  std::function<bool(const SamplingPolicy& policy)> read_by;
  /// Gives the policy what the options say of it; throws std::invalid_argument for unknown ids.
  std::function<void(const PolicyOptions& options, SamplingPolicy& policy)> put;
  /// Reads the value of a --lane's word; returns what is wrong with it, else an empty text.
  std::function<std::string(const std::string& value, PolicyOptions& options)> read;
  /// The value of a policy that reads it, where a --lane has to say it; else nothing.
  std::function<std::optional<std::string>(const SamplingPolicy& policy)> said_of;
  /// Adds the option to a command.
  std::function<void(CLI::App& command, PolicyOptions& options)> add;
};

/// In the order in which they are offered; the policy, which decides what of the others is read,
/// is the first.
std::span<const PolicyWord> policy_words();

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
