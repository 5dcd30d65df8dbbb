#pragma once

#include <array>

#include "renderer/adaptive/policies/policy.h"
#include "renderer/adaptive/policies/policy_parameter.h"

namespace quartet {

// Each is what its file ends in; row_of_policy() in policy.cpp knows which is whose.
extern const PolicyRow vote_policy;
extern const PolicyRow two_level_policy;
extern const PolicyRow batch_policy;
extern const PolicyRow converge_policy;

// And row_of_parameter() in policy_parameter.cpp.
extern const PolicyParameter first_parameter;
extern const PolicyParameter batch_parameter;
extern const PolicyParameter multiplier_parameter;
extern const PolicyParameter stochastic_rounding_parameter;

/// Of policies that look at pixels now and then.
inline constexpr std::array batch_parameters{PolicyParameterId::first, PolicyParameterId::batch};

}  // namespace quartet
