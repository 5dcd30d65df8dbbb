#include "app/rejected_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <numeric>

#include "renderer/adaptive/lab.h"
#include "renderer/measure/rejected_sample.h"

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
  const auto index =
      first_rejected(sample_source(snapshot.scene, snapshot.settings), x, y, most->taken[pixel]);
  assert(index);  // it is one of those that the lane has taken
  fmt::print(stderr,
             "quartet: warning: {} samples were NaN, infinite or negative and left out; the first: "
             "quartet trace {} --pixel {},{} --index {}\n",
             total_rejected(*most), scene_words(options), x, y, index.value_or(0));
}

}  // namespace quartet
