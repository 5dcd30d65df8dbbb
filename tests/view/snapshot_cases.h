#pragma once

#include "renderer/session/snapshot.h"

namespace quartet::test {

/// A snapshot of one pass whose lanes have no samples yet, to be filled in.
inline Snapshot blank_snapshot(int width, int height, std::span<const EstimatorId> estimators) {
  Snapshot snapshot;
  snapshot.width = width;
  snapshot.height = height;
  snapshot.pass = 1;
  for (const EstimatorId id : estimators) {
    LaneSnapshot lane;
    lane.settings = default_settings(id);
    for (std::vector<float>& plane : lane.mean) {
      plane.assign(snapshot.pixels(), 0.0f);
    }
    lane.taken.assign(snapshot.pixels(), 1);
    lane.error.assign(std::size_t(estimator(id).channels) * snapshot.pixels(), 0.0f);
    lane.plan.wanted.assign(snapshot.pixels(), 1);
    PassRecord record;
    record.pass = 1;
    record.samples = snapshot.pixels();
    record.max_spp = 1;
    lane.history.push_back(record);
    snapshot.lanes.push_back(std::move(lane));
  }
  return snapshot;
}

/// Brings histograms and the last record in line with the pixels.
inline void finish(Snapshot& snapshot) {
  for (LaneSnapshot& lane : snapshot.lanes) {
    fill_histogram(lane.taken, lane.sample_histogram);
    lane.error_histograms.resize(lane.error.size() / snapshot.pixels());
    for (std::size_t c = 0; c < lane.error_histograms.size(); ++c) {
      fill_histogram(std::span(lane.error).subspan(c * snapshot.pixels(), snapshot.pixels()),
                     lane.error_histograms[c]);
    }
    for (const std::uint32_t taken : lane.taken) {
      lane.history.back().max_spp = std::max(lane.history.back().max_spp, taken);
    }
  }
}

}  // namespace quartet::test
