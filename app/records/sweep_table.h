#pragma once

#include <string>

#include "renderer/study/sweep_points.h"

namespace quartet {

/// A sweep's ends for people: of every estimator its default thresholds, the best of the sweep and
/// the unbiased twin of the default ones, and uniform sampling after as many samples as the others
/// can take and at its end. Errors and energies with their intervals over the seeds.
std::string sweep_table(const SweepSummary& summary);

}  // namespace quartet
