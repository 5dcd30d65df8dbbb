#pragma once

#include <functional>
#include <vector>

#include "renderer/adaptive/lab.h"

namespace quartet {

/// Each policy with its thresholds multiplied by the one number at which it takes, run to its end,
/// as near to `spp` samples a pixel as it comes: by bisection, all policies at a time out of stored
/// samples. The policies must come to an end (not vote). `progress` gets the share that is done.
std::vector<SamplingPolicy> meet_budget(const SampleSource& source, int width, int height,
                                        std::vector<SamplingPolicy> policies, double spp,
                                        const LabOptions& options,
                                        const std::function<void(double)>& progress);

}  // namespace quartet
