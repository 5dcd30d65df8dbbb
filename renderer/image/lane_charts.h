#pragma once

#include "renderer/adaptive/snapshot.h"
#include "renderer/image/chart.h"

namespace quartet {

// Charts of one lane. Axes reach as far as the lanes of the snapshot that they are compared with.

/// How many pixels have how many samples: pixels on a logarithmic axis, bars in the colours that
/// the heatmap has on `scale`.
Chart sample_chart(const Snapshot& snapshot, std::size_t lane, const ColorScale& scale);

/// How many pixels, in percent, have which raw error, on a logarithmic axis, with a marker a
/// threshold (id: its channel) to be dragged, the part above it shaded, and the share of pixels
/// that will be refined. One channel: bars in `accent`. Three: a line and a marker each, red,
/// green, blue.
///
/// The markers stand at `thresholds`, which may be ahead of the lane's while one is dragged. A lane
/// without errors has an empty chart with a text that says so.
Chart error_chart(const Snapshot& snapshot, std::size_t lane, const Thresholds& thresholds,
                  Rgba8 accent);

/// Samples taken up to each frame, per pixel on average.
Chart progress_chart(const Snapshot& snapshot, std::size_t lane, Rgba8 accent);

}  // namespace quartet
