#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/adaptive/lane_snapshot.h"
#include "renderer/measure/metrics.h"
#include "renderer/trace/integrator.h"

namespace quartet {

class Lab;

/// All lanes at the end of the same pass.
struct Snapshot {
  std::uint64_t number = 0;  ///< grows with each one published by a session
  std::uint64_t request =
      0;  ///< the newest request that it answers, as numbered by Session::submit
  std::shared_ptr<const TraceScene> scene;
  RenderSettings settings;
  int width = 0;
  int height = 0;
  std::uint32_t pass = 0;  ///< of all lanes; 0: nothing yet
  std::vector<LaneSnapshot> lanes;
  /// What true errors are measured against; null if there is nothing.
  std::shared_ptr<const RadianceImage> reference;
  MetricId metric = default_metric;  ///< of true errors
  /// Uniform sampling, with a reference only. Its history ends where it is enough for all lanes
  /// (baseline.h).
  std::optional<LaneSnapshot> baseline;
  /// The picture of `baseline` is of a later pass: lanes went as far before.
  bool baseline_picture_is_later = false;

  std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
};

/// Overwrites size, pass and lanes with what the lab looks like now, using again what memory they
/// have; of true errors it knows nothing. All lanes must be at the same pass. If
/// `last_is_baseline`, the last of them is what the others are compared with, and may be further.
void copy_lanes(const Lab& lab, Snapshot& snapshot, bool last_is_baseline = false);

/// The picture of a lane.
RadianceImage radiance_image(const Snapshot& snapshot, std::size_t lane);
RadianceImage radiance_image(const Snapshot& snapshot, const LaneSnapshot& lane);

}  // namespace quartet
