#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/study/needs/model_error.h"
#include "renderer/study/needs/parts.h"

namespace quartet {

/// Which part of a model does its picture need? Takes out one after the other and measures how far
/// the picture is off without it, and what that saves.
struct NeedsPlan {
  std::vector<PartId> parts;                   ///< that may be taken out
  MetricId metric = MetricId::relmse_trimmed;  ///< not in decibels
  /// The error that a smaller model may have; if none is given, that of the noise floor.
  std::optional<double> error;
  std::uint32_t spp = 32;    ///< of a picture
  std::uint32_t seeds = 8;   ///< pictures of each model, least_seeds at least
  double confidence = 0.95;  ///< of the intervals of all models together, number by number
};

enum class Need {
  needed,      ///< the interval of the error without it lies above the limit
  not_needed,  ///< below
  undecided,   ///< neither; more seeds would tell
};

/// A smaller model, beside the whole one.
struct NeedsRow {
  Simplification simplification;  ///< of several, what they are together, without a function
  ModelError measured;
  double rays = 0.0;        ///< a sample
  double rays_ratio = 0.0;  ///< over those of the whole model
  double seconds_ratio = 0.0;
  Need need = Need::undecided;

  /// What it takes for the same noise, over what the whole model takes: rays times variance.
  Interval cost() const;
};

struct NeedsResult {
  double limit = 0.0;    ///< that errors are compared with
  Interval noise_floor;  ///< noise_of_mean() of the whole model
  /// Whether the whole model's own noise is no more than was asked. If not, nothing else is known.
  bool can_be_met = true;
  double rays = 0.0;           ///< of the whole model, a sample
  double seconds = 0.0;        ///< of a picture of it
  std::vector<NeedsRow> rows;  ///< one a simplification, part by part in the order of the plan
  std::vector<std::size_t> taken_out;  ///< rows, in the order in which they were
  std::optional<NeedsRow> smallest;    ///< all of them together; nothing if none was taken out
  Model smallest_model;
  RejectedCount rejected;  ///< of the model that met most, as far as the scene itself has them
};

/// The smallest model is found greedily: what is not needed alone is taken out in the order of the
/// rays saved per error, and stays out if all together are not seen to be needed either. What has
/// the same mean with and without comes last, and goes if less work does for the same noise.
/// Runs on the threads of the current TBB arena. Nothing if `stop` ended it. `progress` is told how
/// much is done and what is at work.
std::optional<NeedsResult> run_needs(const Model& whole, std::uint64_t first_seed,
                                     const NeedsPlan& plan, std::stop_token stop,
                                     const std::function<void(double, std::string_view)>& progress);

}  // namespace quartet
