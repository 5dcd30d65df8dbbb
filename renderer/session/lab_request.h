#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/adaptive/lane_settings.h"
#include "renderer/base/image.h"
#include "renderer/measure/metrics.h"
#include "renderer/trace/integrator.h"

namespace quartet {

/// What the samples are, and how they are kept. A change to any of it makes a new store: nothing of
/// what was traced is of use.
struct StoreRequest {
  std::shared_ptr<const TraceScene> scene;
  RenderSettings settings;
  std::size_t memory = std::size_t(2) << 30;  ///< of the sample store, bytes
  int threads = 0;                            ///< 0: one a processor
  bool operator==(const StoreRequest&) const = default;
};

/// What is made of the samples. A change to any of it keeps the store: lanes replay out of it, or
/// go on.
struct LaneRequest {
  static constexpr std::uint32_t no_end = UINT32_MAX;

  /// One a lane; at least one. A change replays that lane from pass 1.
  std::vector<LaneSettings> settings;
  /// Where the lanes shall stand, from 1; or no_end. A higher one: they go on. A lower one: they
  /// replay up to it.
  std::uint32_t pass = 15;
  /// Snapshots carry LaneSnapshot::variance. A change replays all lanes.
  bool variance = false;
  /// The truth, of the size of the pictures; null if there is none, and then no estimator may need
  /// it. With one, snapshots carry each lane's error against it, pass by pass, and a lane of
  /// uniform sampling to compare with. A change replays all lanes, unless it takes the truth away:
  /// then only those of estimators that need it.
  std::shared_ptr<const RadianceImage> reference;
  /// Of these errors. A change replays all lanes where there are any.
  MetricId metric = default_metric;
  bool operator==(const LaneRequest&) const = default;
};

/// Everything that is asked of a lab that goes on living: the struct in which a field stands
/// decides what a change to it costs.
struct LabRequest {
  StoreRequest store;
  LaneRequest lanes;
  bool operator==(const LabRequest&) const = default;
};

}  // namespace quartet
