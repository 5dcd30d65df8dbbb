#include "app/commands/lab_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "renderer/adaptive/run_lab.h"

namespace quartet {
namespace {

/// A lane that has ended goes on as one that wants nothing, so that nothing is traced for it.
void park(Lab& lab, std::size_t lane) {
  LaneSettings nothing = default_settings(EstimatorId::uniform);
  nothing.max_spp = 1;
  lab.set_settings(lane, nothing);
}

bool all_at_one_pass(const Lab& lab) {
  return std::ranges::all_of(lab.lanes(),
                             [&](const Lane& lane) { return lane.pass() == lab.pass(); });
}

}  // namespace

Snapshot run_to_end(Lab& lab, const StopConditions& stop,
                    std::shared_ptr<const RadianceImage> reference) {
  const Interrupt interrupt;
  Progress progress("rendering");
  const std::size_t count = lab.lanes().size();
  std::vector<bool> ended(count, false);
  std::vector<LaneSnapshot> ends(count);
  Snapshot now;
  const bool finished = run_lab(lab, interrupt.token(), [&] {
    if (!all_at_one_pass(lab)) {
      return true;  // parked lanes, which begin anew, catch up
    }
    double least = 1.0;
    std::vector<std::size_t> ending;
    for (std::size_t i = 0; i < count; ++i) {
      const double done = ended[i] ? 1.0 : stop.progress(lab.lanes()[i], reference.get());
      least = std::min(least, done);
      if (!ended[i] && done >= 1.0) {
        ending.push_back(i);
      }
    }
    progress.update(least, fmt::format("pass {}", lab.pass()));
    if (ending.empty()) {
      return true;
    }
    copy_lanes(lab, now);
    for (const std::size_t lane : ending) {
      ended[lane] = true;
      ends[lane] = std::move(now.lanes[lane]);
    }
    if (least < 1.0) {
      for (const std::size_t lane : ending) {
        park(lab, lane);
      }
    }
    return std::ranges::count(ended, false) > 0;
  });
  if (!finished) {
    throw Interrupted();
  }
  now.lanes = std::move(ends);
  now.reference = std::move(reference);
  return now;
}

}  // namespace quartet
