#include "renderer/study/experiment.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "renderer/adaptive/run_lab.h"
#include "renderer/base/parallel.h"
#include "renderer/measure/energy.h"
#include "renderer/measure/top_share.h"

namespace quartet {
namespace {

/// A lab of one lane, which no run has used yet: it costs nothing before its first pass.
Lab idle_lab(SampleSource source, int width, int height, LabOptions options,
             const std::shared_ptr<const RadianceImage>& reference) {
  const LaneSettings settings = default_settings(EstimatorId::uniform);
  options.reference = reference;
  return {std::move(source), width, height, std::span(&settings, 1), options};
}

bool is_measured(const RunPlan& plan, std::uint32_t pass) {
  return plan.measure_at == MeasureAt::every_pass ||
         (plan.measure_at == MeasureAt::powers_of_two && std::has_single_bit(pass)) ||
         std::ranges::binary_search(plan.also_at, pass);
}

}  // namespace

double effort_of(Effort effort, const Measurement& run) {
  switch (effort) {
    case Effort::seconds:
      return run.record.seconds;
    case Effort::rays:
      return run.mean_rays;
    case Effort::mean_spp:
      return run.mean_spp;
  }
  return 0.0;
}

Experiment::Experiment(SampleSource source, int width, int height, const LabOptions& options,
                       std::shared_ptr<const RadianceImage> reference)
    : reference_(std::move(reference)),
      source_(source),
      lab_(idle_lab(std::move(source), width, height, options, reference_)) {
}

Measurement Experiment::measure(const RunPlan& plan, bool is_end) const {
  Measurement measurement;
  measurement.record = lane().history().back();
  measurement.mean_spp = mean_spp(measurement.record, lane().film().size());
  measurement.mean_rays = mean_rays(measurement.record, lane().film().size());
  if (!plan.metrics.empty()) {
    const RadianceImage image = lane().film().image();
    const std::size_t count =
        is_end ? plan.metrics.size() : std::min(plan.metrics.size(), plan.metrics_on_the_way);
    for (const MetricId id : std::span(plan.metrics).first(count)) {
      measurement.values.push_back(metric(id).compute(image, *reference_));
      if (id == MetricId::relmse) {
        measurement.relmse_top = relmse_top_share(image, *reference_);
      }
    }
    measurement.energy = energy_error(image, *reference_);
    if (plan.each_picture) {
      plan.each_picture(lane().pass(), image);
    }
  }
  return measurement;
}

std::optional<std::vector<Measurement>> Experiment::run(
    const RunPlan& plan, std::stop_token stop, const std::function<void(double)>& progress) {
  if (!plan.stop.any()) {
    throw std::invalid_argument("an experiment needs a condition that ends it");
  }
  if (!reference_ && (!plan.metrics.empty() || plan.stop.error)) {
    throw std::invalid_argument("an error can only be measured against a reference");
  }
  lab_.set_settings(0, plan.settings);
  std::vector<Measurement> measurements;
  const bool ended = run_lab(lab_, stop, [&] {
    const double done = plan.stop.progress(lane(), reference_.get());
    if (done >= 1.0 || is_measured(plan, lane().pass())) {
      measurements.push_back(measure(plan, done >= 1.0));
    }
    if (progress) {
      progress(std::min(done, 1.0));
    }
    return done < 1.0;
  });
  if (!ended) {
    return std::nullopt;
  }
  samples_used_ += measurements.back().record.samples;
  return measurements;
}

Film Experiment::first_samples(std::uint32_t spp) const {
  Film film(width(), height(), {.variance = true});
  film.keep_sums();
  const std::vector<std::uint32_t> none(film.size(), 0);
  const std::vector<std::uint16_t> all(film.size(), std::uint16_t(spp));
  const bool stored = store().holds(none, all);
  parallel_for(film.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<glm::vec3> samples(spp);
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      if (stored) {
        store().read(pixel, 0, samples);
      } else {
        source_(int(pixel) % width(), int(pixel) / width(), 0, samples);
      }
      film.add(pixel, samples);
    }
  });
  return film;
}

}  // namespace quartet
