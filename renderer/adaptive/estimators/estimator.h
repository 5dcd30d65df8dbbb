#pragma once

#include <array>
#include <span>
#include <string_view>

#include "renderer/adaptive/film/film.h"

namespace quartet {

enum class EstimatorId {
  contrast,
  kl,
  chi2,
  hellinger,
  confidence,
  variance,
  half_buffer,
  cycles,
  rigau_kl,
  rigau_chi2,
  rigau_hellinger,
  oracle,
  uniform,
  uniform_clamp,
  // Controls, see Estimator::control.
  oracle_expected,
  lottery,
  endless,
};

enum class PolicyId;  // policy.h
struct WindowKernel;  // window_kernel.h

/// One threshold a channel of the estimator; the rest is not looked at.
using Thresholds = std::array<float, 3>;

/// What an estimator looks at.
struct EstimatorInput {
  const Film& film;  ///< with the statistics that the estimator needs
  /// The true radiance of every pixel, for an estimator that needs it; else it may be empty.
  std::span<const glm::vec3> reference = {};
};

/// One row of the table of error estimators: everything the program knows about one. Combo boxes,
/// command line, file headers and tests walk the table.
struct Estimator {
  EstimatorId key;
  std::string_view id;                ///< on the command line and in files
  std::string_view label;             ///< for people
  std::string_view unit;              ///< of the error and its thresholds
  std::string_view source;            ///< of the formula
  std::string_view threshold_source;  ///< of the default thresholds
  /// Errors a pixel: 3 (R, G, B), 1, or 0 for a method without an error, which samples evenly.
  int channels;
  Thresholds default_thresholds;
  /// Writes the raw error of every pixel, channel by channel (channels × film.size()): finite and
  /// not negative, or infinite where a pixel has too few samples to be judged, which is above every
  /// threshold. Null where channels is 0. Runs on the threads of the current TBB arena.
  void (*estimate)(const EstimatorInput& input, std::span<float> error);
  /// The same, row by row, of an estimator that looks at nothing but means in 3 × 3 windows.
  const WindowKernel* window = nullptr;
  /// The policy that its authors pair it with.
  PolicyId default_policy;
  FilmStatistics needs = {};
  bool needs_reference = false;
  /// Samples below which a pixel is not done, whatever its error; 0 if the error alone decides.
  std::uint32_t (*minimum_samples)(const Thresholds& thresholds) = nullptr;
  /// Samples between two looks at a pixel, under policies that leave it to the estimator; 0: the
  /// policy's own.
  std::uint16_t look_every = 0;
  /// Its error is that variance of the mean which the film has (Film::luminance_deviations): right
  /// under the samplers that know it, and under the others as published, as if samples were
  /// independent.
  bool judges_variance = false;
  /// What its source takes a pixel's samples to be.
  std::string_view assumes = "any samples: it looks at the means of pixels";
  /// Stands beside the others in a study, to show what the study can tell apart; nobody would
  /// choose it to make a picture.
  bool control = false;
};

/// What is offered: all but the controls.
std::span<const Estimator> estimators();
const Estimator& estimator(EstimatorId key);
/// Of those that are offered. Throws std::invalid_argument that lists the legal ids.
const Estimator& find_estimator(std::string_view id);

}  // namespace quartet
