#include "app/rejected_report.h"

#include <fmt/format.h>

#include <cstdio>

#include "renderer/adaptive/lab.h"
#include "renderer/trace/running_mean.h"

namespace quartet {

void report_rejected(const RejectedSamples& rejected, RunOptions options,
                     std::shared_ptr<const TraceScene> scene, RenderSettings settings) {
  if (rejected.count == 0) {
    return;
  }
  options.seed = settings.seed = rejected.seed;
  const int x = int(rejected.pixel) % settings.width;
  const int y = int(rejected.pixel) / settings.width;
  const SampleSource source = sample_source(std::move(scene), settings);
  glm::vec3 sample(0.0f);
  std::uint32_t index = 0;
  while (index + 1 < rejected.taken) {
    source(x, y, index, std::span(&sample, 1));
    if (!acceptable(sample)) {
      break;
    }
    ++index;
  }
  fmt::print(stderr,
             "quartet: warning: {} samples were NaN, infinite or negative and left out; the first: "
             "quartet trace {} --pixel {},{} --index {}\n",
             rejected.count, scene_words(options), x, y, index);
}

void report_rejected(const Snapshot& snapshot, const RunOptions& options) {
  RejectedSamples most;
  for (const LaneSnapshot& lane : snapshot.lanes) {
    keep_most(most, rejected_of(lane.rejected, lane.taken, snapshot.settings.seed));
  }
  report_rejected(most, options, snapshot.scene, snapshot.settings);
}

}  // namespace quartet
