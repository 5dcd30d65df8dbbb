#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/adaptive/histogram.h"
#include "renderer/adaptive/lane.h"
#include "renderer/measure/metrics.h"
#include "renderer/trace/integrator.h"

namespace quartet {

class Lab;

/// What one lane looked like at the end of a frame: plain data, copied out of the lane, so that it
/// may be kept and read while the lane goes on. Pixels are in rows from the top left.
struct LaneSnapshot {
  SamplingPolicy policy;
  std::array<std::vector<float>, 3> mean;  ///< linear radiance: red, green, blue of every pixel
  std::vector<std::uint32_t> taken;        ///< samples each pixel has used, rejected ones included
  std::vector<std::uint32_t> rejected;     ///< of these, a pixel; empty if none was
  /// Raw, in the estimator's unit: its channels × pixels; empty for an estimator without one.
  std::vector<float> error;
  /// Of the pixel mean: red, green, blue × pixels, in radiance²; the largest float where that is
  /// less; empty where the films keep none.
  std::vector<float> variance;
  std::vector<FrameRecord> history;              ///< see frame_history.h; back() is the current one
  Plan plan;                                     ///< of the next frame
  SampleHistogram sample_histogram;              ///< of `taken`
  std::vector<ErrorHistogram> error_histograms;  ///< one a channel of the estimator
};

/// All lanes at the end of the same frame.
struct Snapshot {
  std::uint64_t number = 0;  ///< grows with each one published by a session
  std::uint64_t request =
      0;  ///< the newest request that it answers, as numbered by Session::submit
  std::shared_ptr<const TraceScene> scene;
  RenderSettings settings;
  int width = 0;
  int height = 0;
  std::uint32_t frame = 0;  ///< of all lanes; 0: nothing yet
  std::vector<LaneSnapshot> lanes;
  /// What true errors are measured against; null if there is nothing.
  std::shared_ptr<const RadianceImage> reference;
  MetricId metric = MetricId::relmse;    ///< of true errors
  std::optional<LaneSnapshot> baseline;  ///< uniform sampling; with a reference only

  std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
};

/// Overwrites size, frame and lanes with what the lab looks like now, using again what memory they
/// have; of true errors it knows nothing. All lanes must be at the same frame. If
/// `last_is_baseline`, the last of them is what the others are compared with.
void copy_lanes(const Lab& lab, Snapshot& snapshot, bool last_is_baseline = false);

}  // namespace quartet
