#include "renderer/measure/evaluation.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "renderer/image/quality_chart.h"
#include "renderer/image/views.h"

namespace quartet {
namespace {

MetricValues none() {
  return MetricValues(metrics().size(), std::nan(""));
}

/// Errors are compared in units of their thresholds, so that channels can be compared too.
LaneQuality quality_of(const LaneSnapshot& lane, const RadianceImage& image,
                       const RadianceImage& truth) {
  constexpr std::size_t groups = 40;
  const ScalarImage true_error = metric(MetricId::mse).map(image, truth);
  const std::vector<float> estimated = largest_scaled_errors(lane);
  LaneQuality quality;
  quality.rank_correlation = std::nan("");
  if (!estimated.empty()) {
    quality.calibration = calibration_curve(estimated, true_error.pixels(), groups);
    quality.rank_correlation = rank_correlation(estimated, true_error.pixels());
    quality.stops = false_stops(pixel_states(lane), true_error.pixels());
  }
  return quality;
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
  if (input.snapshot->baseline) {
    images.push_back(radiance_image(*input.snapshot, *input.snapshot->baseline));
  }
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
      next.noise_floor[m] = input.reference->noise_floor(row.key);
    }
    publish(next);
  }
  auto qualities = std::make_shared<std::vector<LaneQuality>>();
  for (std::size_t i = 0; i < input.snapshot->lanes.size(); ++i) {
    if (stop.stop_requested()) {
      return;
    }
    qualities->push_back(quality_of(input.snapshot->lanes[i], images[i], input.reference->image));
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
