#include "renderer/session/snapshot.h"

#include <algorithm>
#include <cassert>

#include "renderer/adaptive/lab.h"
#include "renderer/base/parallel.h"
#include "renderer/session/baseline.h"

namespace quartet {
namespace {

/// Ends the baseline's history where it is enough for the lanes, wherever it was taken for others.
void end_baseline(Snapshot& snapshot) {
  std::vector<PassRecord> ends;
  for (const LaneSnapshot& lane : snapshot.lanes) {
    if (!lane.history.empty()) {
      ends.push_back(lane.history.back());
    }
  }
  std::vector<PassRecord>& history = snapshot.baseline->history;
  const auto enough = std::ranges::find_if(
      history, [&](const PassRecord& record) { return is_enough(record, ends); });
  snapshot.baseline_picture_is_later = history.end() - enough > 1;
  if (snapshot.baseline_picture_is_later) {
    history.erase(enough + 1, history.end());
  }
}

}  // namespace

void copy_lanes(const Lab& lab, Snapshot& snapshot, bool last_is_baseline) {
  snapshot.width = lab.width();
  snapshot.height = lab.height();
  snapshot.pass = lab.pass();
  const std::span<const Lane> lanes = lab.lanes();
  const std::size_t compared = last_is_baseline ? lanes.size() - 1 : lanes.size();
  assert(std::ranges::all_of(lanes.first(compared),
                             [&](const Lane& lane) { return lane.pass() == snapshot.pass; }));
  snapshot.lanes.resize(compared);
  if (!last_is_baseline) {
    snapshot.baseline.reset();
  } else if (!snapshot.baseline) {
    snapshot.baseline.emplace();
  }
  lab.threads().execute([&] {
    parallel_for(lanes.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        copy_lane(lanes[i], i < compared ? snapshot.lanes[i] : *snapshot.baseline);
      }
    });
  });
  if (last_is_baseline) {
    end_baseline(snapshot);
  }
}

RadianceImage radiance_image(const Snapshot& snapshot, std::size_t lane) {
  return radiance_image(snapshot, snapshot.lanes[lane]);
}

RadianceImage radiance_image(const Snapshot& snapshot, const LaneSnapshot& lane) {
  const auto& mean = lane.mean;
  RadianceImage image(snapshot.width, snapshot.height);
  for (std::size_t i = 0; i < image.size(); ++i) {
    image.pixels()[i] = {mean[0][i], mean[1][i], mean[2][i]};
  }
  return image;
}

}  // namespace quartet
