#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "renderer/adaptive/lane_settings.h"

namespace quartet {

/// What is studied of a lane: how its samples are dealt out, and by which thresholds.
enum class Terms {
  budget,  ///< a policy that ends, thresholds scaled so that the lane takes the common budget
  window,  ///< as the window begins: policy vote, thresholds as they come, so many passes
};

/// One row of the table of terms.
struct TermsRow {
  Terms key;
  std::string_view id;
};
std::span<const TermsRow> terms_table();
const TermsRow& terms_row(Terms key);

/// What stands in the matrix beside the estimators, and why.
enum class Role {
  baseline,  ///< what the others are measured by
  studied,
  planted,  ///< a mistake made on purpose, which a rule has to find
};
std::string_view role_id(Role role);

/// One column of the matrix.
struct Subject {
  std::string_view id;
  Role role = Role::studied;
  LaneSettings settings;  ///< with thresholds as they come
};

/// One row of the table of planted mistakes.
struct Planted {
  std::string_view id;                      ///< of its column
  std::string_view mistake;                 ///< one sentence
  std::string_view rule;                    ///< the id of the one that has to find it
  std::span<const std::string_view> cases;  ///< the ids of those where it has to
  LaneSettings (*settings)();
};

std::span<const Planted> planted_mistakes();

/// Uniform sampling, the oracle, the given estimators, the planted mistakes; all but the last with
/// their default thresholds and parameters. Whoever has no thresholds runs to the budget; `policy`
/// is one that ends.
std::vector<Subject> stability_subjects(std::span<const EstimatorId> studied, PolicyId policy,
                                        double budget);

/// The maximum that a pixel may have, in multiples of the budget.
inline constexpr double maximum_over_budget = 8.0;

}  // namespace quartet
