#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "renderer/measure/reference/reference.h"
#include "renderer/session/background_task.h"
#include "renderer/session/snapshot.h"

namespace quartet {

/// One number for each row of the table of metrics, in its order; NaN where there is none (yet).
using MetricValues = std::vector<double>;

struct EstimatorQuality;

/// What all metrics say of the lanes of a snapshot.
struct Evaluation {
  std::shared_ptr<const Snapshot> snapshot;
  std::shared_ptr<const Reference> reference;
  MetricValues noise_floor;         ///< of the reference
  std::vector<MetricValues> lanes;  ///< of the snapshot, in its order
  MetricValues baseline;            ///< of its uniform sampling, where it has the picture
  /// Of the lanes' estimators; null until it is known.
  std::shared_ptr<const std::vector<EstimatorQuality>> quality;
  bool complete = false;  ///< nothing more will come
};

/// What is to be evaluated.
struct EvaluationInput {
  std::shared_ptr<const Snapshot> snapshot;
  std::shared_ptr<const Reference> reference;  ///< of the snapshot's size
};

/// Evaluations beside the window: FLIP alone takes longer than a frame.
using EvaluationTask = BackgroundTask<EvaluationInput, Evaluation>;

/// The work of such a task: publishes whenever a metric is known for all lanes, the quick ones
/// first. Keeps noise floors of the reference that it saw last.
EvaluationTask::Work evaluation_work();

}  // namespace quartet
