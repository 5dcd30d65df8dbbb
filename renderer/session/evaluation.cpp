#include "renderer/session/evaluation.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "renderer/measure/quality.h"
#include "renderer/measure/reference/noise_floors.h"

namespace quartet {
namespace {

MetricValues none() {
  return MetricValues(metrics().size(), std::nan(""));
}

void evaluate(const EvaluationInput& input, const std::stop_token& stop,
              const EvaluationTask::Publish& publish, Evaluation& last) {
  Evaluation next;
  next.snapshot = input.snapshot;
  next.reference = input.reference;
  const bool floors_are_known = last.reference == input.reference && !last.noise_floor.empty();
  next.noise_floor = floors_are_known ? last.noise_floor : none();
  next.lanes.assign(input.snapshot->lanes.size(), none());
  next.baseline = none();
  std::vector<RadianceImage> images;
  for (const LaneSnapshot& lane : input.snapshot->lanes) {
    images.push_back(radiance_image(*input.snapshot, lane));
  }
  if (input.snapshot->baseline && !input.snapshot->baseline_picture_is_later) {
    images.push_back(radiance_image(*input.snapshot, *input.snapshot->baseline));
  }
  NoiseFloors floors(*input.reference);
  for (std::size_t m = 0; m < metrics().size(); ++m) {
    const Metric& row = metrics()[m];
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (stop.stop_requested()) {
        return;
      }
      MetricValues& values = i < next.lanes.size() ? next.lanes[i] : next.baseline;
      values[m] = row.compute(images[i], input.reference->image);
    }
    if (!floors_are_known) {
      next.noise_floor[m] = floors.of(row);
    }
    publish(next);
  }
  auto qualities = std::make_shared<std::vector<EstimatorQuality>>();
  for (std::size_t i = 0; i < input.snapshot->lanes.size(); ++i) {
    if (stop.stop_requested()) {
      return;
    }
    const ScalarImage true_error = metric(MetricId::mse).map(images[i], input.reference->image);
    qualities->push_back(quality_of(input.snapshot->lanes[i], true_error.pixels()));
  }
  next.quality = std::move(qualities);
  next.complete = true;
  publish(next);
  last = next;
}

}  // namespace

EvaluationTask::Work evaluation_work() {
  return [last = std::make_shared<Evaluation>()](const EvaluationInput& input,
                                                 const std::stop_token& stop,
                                                 const EvaluationTask::Publish& publish) {
    try {
      if (input.snapshot && input.reference) {
        evaluate(input, stop, publish, *last);
      } else {
        publish({});
      }
    } catch (const std::exception&) {
      // A picture with which a metric means nothing, or one too large: its number stays unknown.
      publish({});
    }
  };
}

}  // namespace quartet
