#include "app/records/rejected_report.h"

#include <fmt/format.h>

#include <cassert>

#include "app/terminal/messages.h"
#include "renderer/adaptive/lab.h"
#include "renderer/session/find_rejected.h"

namespace quartet {

void report_rejected(const RejectedCount& rejected, RunOptions options,
                     std::shared_ptr<const TraceScene> scene, RenderSettings settings) {
  if (rejected.count == 0) {
    return;
  }
  options.seed = settings.seed = rejected.seed;
  const int x = int(rejected.pixel) % settings.width;
  const int y = int(rejected.pixel) / settings.width;
  const auto index =
      first_rejected(sample_source(std::move(scene), settings), x, y, rejected.taken);
  assert(index);  // it is one of those that were taken
  warn(
      "{} samples were NaN, infinite or negative and left out; the first: quartet trace {} --pixel "
      "{},{} --index {}",
      rejected.count, scene_words(options), x, y, index.value_or(0));
}

void report_rejected(const Snapshot& snapshot, const RunOptions& options) {
  RejectedCount most;
  for (const LaneSnapshot& lane : snapshot.lanes) {
    keep_most(most, rejected_of(lane.rejected, lane.taken, snapshot.settings.seed));
  }
  report_rejected(most, options, snapshot.scene, snapshot.settings);
}

}  // namespace quartet
