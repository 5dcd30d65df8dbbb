#pragma once

#include "app/run_options.h"
#include "renderer/adaptive/snapshot.h"

namespace quartet {

/// If a lane met samples that no film takes (NaN, infinite or negative), says on stderr how many,
/// and with which command the first of them can be looked at.
void report_rejected(const Snapshot& snapshot, const RunOptions& options);

}  // namespace quartet
