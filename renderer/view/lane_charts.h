#pragma once

#include <algorithm>
#include <optional>

#include "renderer/session/snapshot.h"
#include "renderer/view/chart.h"

namespace quartet {

// Charts of one lane. Axes reach as far as the lanes of the snapshot that they are compared with.

/// How many pixels have how many samples: pixels on a logarithmic axis, bars in the colours that
/// the heatmap has on `scale`.
Chart sample_chart(const Snapshot& snapshot, std::size_t lane, const ColorScale& scale);

/// Powers of ten that an axis spans.
struct DecadeRange {
  int first = 0;
  int last = 1;

  DecadeRange with(const DecadeRange& other) const {
    return {std::min(first, other.first), std::max(last, other.last)};
  }
  bool operator==(const DecadeRange&) const = default;
};

/// The powers of ten that hold nearly all errors and every threshold with room to drag it.
DecadeRange error_decades(const LaneSnapshot& lane, const Thresholds& thresholds);

/// How many pixels, in percent, have which raw error, on a logarithmic axis, with a marker a
/// threshold (id: its channel) to be dragged, the part above it shaded, and the share of pixels
/// that are not done. One channel: bars in `accent`. Three: a line and a marker each, red,
/// green, blue.
///
/// The markers stand at `thresholds`, which may be ahead of the lane's while one is dragged. A lane
/// without errors has an empty chart with a text that says so. `decades` is what the axis spans;
/// what suits errors and thresholds if not given.
Chart error_chart(const Snapshot& snapshot, std::size_t lane, const Thresholds& thresholds,
                  Rgba8 accent, std::optional<DecadeRange> decades = {});

/// Samples taken up to each pass, per pixel on average.
Chart progress_chart(const Snapshot& snapshot, std::size_t lane, Rgba8 accent);

}  // namespace quartet
