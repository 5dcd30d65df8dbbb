#pragma once

#include "renderer/measure/capped.h"
#include "renderer/measure/stop_conditions.h"
#include "renderer/session/snapshot.h"

namespace quartet {

/// Lines on stderr for lanes that ended before any of the conditions that the user gave was met,
/// because no pixel wanted, or might have, another sample; and for pixels that have as many samples
/// as --max-spp allows. `snapshot` is of the end.
void tell_if_short(const Snapshot& snapshot, const StopConditions& given);

/// A line on stderr if there are pixels in a run that have as many samples as --max-spp allows: in
/// a lane, or in that of many runs which has most of them.
enum class CappedRun { lane, most_of_many };
void tell_if_capped(const CappedPixels& capped, CappedRun run = CappedRun::lane);

}  // namespace quartet
