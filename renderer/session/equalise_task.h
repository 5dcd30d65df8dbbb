#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "renderer/session/background_task.h"
#include "renderer/session/lab_request.h"
#include "renderer/study/calibrate.h"

namespace quartet {

/// Lanes that are to get, or to reach, the same.
struct EqualiseRequest {
  StoreRequest store;  ///< without a scene: nothing is wanted any more
  std::vector<LaneSettings> lane_settings;
  CommonBudget budget;
  std::shared_ptr<const RadianceImage> reference;  ///< for an error as the budget
};

struct EqualiseStatus {
  bool done = false;
  std::size_t lanes = 0;                  ///< of the request
  std::vector<Calibration> calibrations;  ///< of the first of them, as far as it has come
  std::string error;                      ///< why there is no more, in one line
};

/// Calibrations beside the window: each lane's thresholds are found by replays, of which the first
/// traces what it needs. Samples are kept, so that the next request for the same scene and settings
/// traces little.
using EqualiseTask = BackgroundTask<EqualiseRequest, EqualiseStatus>;
EqualiseTask::Work equalise_work();

/// What to tell about it when it is done: for each lane that could not meet the budget,
/// or is better than an error that was asked for, why.
std::string equalise_text(const EqualiseRequest& request, const EqualiseStatus& status);

}  // namespace quartet
