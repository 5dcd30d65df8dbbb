#include "app/rejected_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "renderer/adaptive/lab.h"
#include "renderer/trace/running_mean.h"

namespace quartet {
namespace {

std::uint64_t total_rejected(const LaneSnapshot& lane) {
  return std::accumulate(lane.rejected.begin(), lane.rejected.end(), std::uint64_t(0));
}

}  // namespace

void report_rejected(const Snapshot& snapshot, const RunOptions& options) {
  const auto most = std::ranges::max_element(snapshot.lanes, {}, total_rejected);
  if (most == snapshot.lanes.end() || total_rejected(*most) == 0) {
    return;
  }
  const auto pixel =
      std::size_t(std::ranges::find_if(most->rejected, [](std::uint32_t n) { return n > 0; }) -
                  most->rejected.begin());
  const int x = int(pixel) % snapshot.width;
  const int y = int(pixel) / snapshot.width;
  const SampleSource source = sample_source(snapshot.scene, snapshot.settings);
  glm::vec3 sample(0.0f);
  std::uint32_t index = 0;
  while (index + 1 < most->taken[pixel]) {
    source(x, y, index, std::span(&sample, 1));
    if (!acceptable(sample)) {
      break;
    }
    ++index;
  }
  fmt::print(stderr,
             "quartet: warning: {} samples were NaN, infinite or negative and left out; the first: "
             "quartet trace {} --pixel {},{} --index {}\n",
             total_rejected(*most), scene_words(options), x, y, index);
}

}  // namespace quartet
