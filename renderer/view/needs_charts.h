#pragma once

#include <vector>

#include "renderer/study/needs/needs.h"
#include "renderer/view/chart.h"

namespace quartet {

/// The error of each smaller model against the rays a sample that it takes, and against the
/// seconds, as ratios to the whole model's, with intervals and the limit: what lies under it is not
/// needed. On logarithmic axes; what is not above the lower edge stands on it. Depths are one line.
/// Diamonds are needed, dots not, crosses undecided. In colours for paper. None if nothing was
/// taken out.
std::vector<Chart> needs_charts(const NeedsResult& result, const NeedsPlan& plan);

}  // namespace quartet
