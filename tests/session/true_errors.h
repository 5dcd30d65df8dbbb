#pragma once

#include <vector>

#include "renderer/adaptive/lane_snapshot.h"

namespace quartet::test {

/// Of each pass in a lane's history.
inline std::vector<double> true_errors(const LaneSnapshot& lane) {
  std::vector<double> errors;
  for (const PassRecord& record : lane.history) {
    errors.push_back(record.truth.error);
  }
  return errors;
}

}  // namespace quartet::test
