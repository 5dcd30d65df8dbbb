#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "renderer/adaptive/policies/policy.h"

namespace quartet {

// What a parameter is, and what it may be, both ends included.

struct CountParameter {
  std::uint16_t Policy::*member;
  std::uint16_t low;
  std::uint16_t high;
};

struct RealParameter {
  float Policy::*member;
  float low;
  float high;
  float usual_high;  ///< of a slider from `low` on
};

struct FlagParameter {
  bool Policy::*member;
};

/// One row of the table of parameters of policies. Command line, lanes, files and window walk
/// it; which policies read one, their rows say.
struct PolicyParameter {
  PolicyParameterId key;
  std::string_view id;       ///< in files, and, with dashes, as an option: --first-samples
  std::string_view word;     ///< in a --lane
  std::string_view label;    ///< in the window
  std::string_view help;     ///< of the option; the policies that read it go before
  std::string_view tooltip;  ///< in the window
  std::variant<CountParameter, RealParameter, FlagParameter> value;
};

/// In the order of their keys.
std::span<const PolicyParameter> policy_parameters();
const PolicyParameter& policy_parameter(PolicyParameterId key);

/// Sets a parameter as it is in another policy.
void copy_parameter(const PolicyParameter& row, const Policy& from, Policy& to);

bool reads(const PolicyRow& row, PolicyParameterId parameter);
/// Whether the policy of these settings reads it: nothing under an estimator without an error,
/// which has nothing to choose by.
bool reads(const LaneSettings& settings, PolicyParameterId parameter);

}  // namespace quartet
