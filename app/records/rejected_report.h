#pragma once

#include "app/options/run_options.h"
#include "renderer/measure/rejected_count.h"
#include "renderer/session/snapshot.h"

namespace quartet {

/// If there are samples that no film takes (NaN, infinite or negative), says on stderr in one line
/// how many, and with which command the first of them can be looked at. They are of the scene with
/// these settings but for the seed, as the options say.
void report_rejected(const RejectedCount& rejected, RunOptions options,
                     std::shared_ptr<const TraceScene> scene, RenderSettings settings);

/// The same of the lane that met most of them.
void report_rejected(const Snapshot& snapshot, const RunOptions& options);

}  // namespace quartet
