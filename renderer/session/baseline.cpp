#include "renderer/session/baseline.h"

#include <algorithm>

namespace quartet {

bool is_enough(const PassRecord& uniform, std::span<const PassRecord> lanes) {
  return std::ranges::all_of(lanes, [&](const PassRecord& lane) {
    const bool as_long =
        uniform.seconds >= lane.seconds || double(uniform.samples) >= 1.25 * double(lane.samples);
    return uniform.samples >= lane.samples && uniform.rays >= lane.rays && as_long;
  });
}

}  // namespace quartet
