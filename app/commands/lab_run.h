#pragma once

#include <memory>

#include "renderer/adaptive/lab.h"
#include "renderer/measure/stop_conditions.h"
#include "renderer/session/snapshot.h"

namespace quartet {

/// Runs each lane to its own end, with a progress bar, and returns how each looked there; `pass`
/// is that of the lane that ran longest. What it looks like with lanes at different passes is the
/// lab's affair: it is of no use afterwards but for its store. Throws Interrupted.
Snapshot run_to_end(Lab& lab, const StopConditions& stop,
                    std::shared_ptr<const RadianceImage> reference);

}  // namespace quartet
