#pragma once

#include "renderer/base/interval.h"
#include "renderer/measure/metrics.h"
#include "renderer/study/needs/model_pictures.h"

namespace quartet {

/// The least seeds with which a model's error has an interval.
inline constexpr std::uint32_t least_seeds = 3;

/// What a metric, not in decibels, says of the mean of a model's pictures over all seeds because it
/// is made of so few samples. From each picture compared with the mean of the others, less by what
/// noise that has itself, and by how much less noise a mean has; with its interval at confidence
/// 1 − p.
Interval noise_of_mean(const Metric& metric, const ModelPictures& model, double p);

/// How far one model's pictures are from another's.
struct ModelError {
  /// The metric of the mean picture over all seeds against that of the whole model, whose random
  /// numbers it shares, less what is noise in their difference. A picture that differs by noise
  /// alone has 0, give or take; a squared error may come out below.
  Interval error;
  /// What was taken off: the metric of a difference as large as the noise that the difference of
  /// the means has, as the spread of the differences over the seeds tells.
  double noise = 0.0;
  Interval energy;  ///< energy_error() against the whole model, of each seed
  /// The variance of a picture over that of one of the whole model, geometric mean over the seeds;
  /// NaN where the whole model has none.
  Interval variance;
};

/// Both have the same seeds, least_seeds at least. Intervals are at confidence 1 − p; that of the
/// error is a jackknife (Tukey 1958; Miller, Biometrika 61(1), 1974), which leaves out one seed
/// after the other.
ModelError error_of_model(const Metric& metric, const ModelPictures& whole,
                          const ModelPictures& model, double p);

}  // namespace quartet
