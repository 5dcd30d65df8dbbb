#pragma once

#include "renderer/adaptive/estimators/estimator.h"
#include "renderer/adaptive/policies/policy.h"

namespace quartet {

// Each is what its file ends in; row_of_estimator() in estimator.cpp knows which is whose.
extern const Estimator contrast_estimator;
extern const Estimator kl_estimator;
extern const Estimator chi2_estimator;
extern const Estimator hellinger_estimator;
extern const Estimator confidence_estimator;
extern const Estimator variance_estimator;
extern const Estimator half_buffer_estimator;
extern const Estimator cycles_estimator;
extern const Estimator rigau_kl_estimator;
extern const Estimator rigau_chi2_estimator;
extern const Estimator rigau_hellinger_estimator;
extern const Estimator oracle_estimator;
extern const Estimator uniform_estimator;
extern const Estimator uniform_clamp_estimator;
extern const Estimator oracle_expected_estimator;
extern const Estimator lottery_estimator;
extern const Estimator endless_estimator;

inline constexpr std::string_view rigau_2003 =
    "Rigau, Feixas and Sbert 2003, Refinement Criteria Based on f-Divergences";

}  // namespace quartet
