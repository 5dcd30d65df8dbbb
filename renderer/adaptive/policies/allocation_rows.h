#pragma once

#include <array>

#include "renderer/adaptive/policy.h"
#include "renderer/adaptive/policy_parameter.h"

namespace quartet {

// Each is what its file ends in; row_of_allocation() in policy.cpp knows which is whose.
extern const AllocationRow vote_allocation;
extern const AllocationRow two_level_allocation;
extern const AllocationRow batch_allocation;
extern const AllocationRow converge_allocation;

// And row_of_parameter() in policy_parameter.cpp.
extern const PolicyParameter first_parameter;
extern const PolicyParameter batch_parameter;
extern const PolicyParameter multiplier_parameter;
extern const PolicyParameter stochastic_rounding_parameter;

/// Of allocations that look at pixels now and then.
inline constexpr std::array batch_parameters{PolicyParameterId::first, PolicyParameterId::batch};

}  // namespace quartet
