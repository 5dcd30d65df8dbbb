#pragma once

#include <array>
#include <span>
#include <string_view>

#include "renderer/adaptive/film.h"

namespace quartet {

enum class EstimatorId { uniform, contrast, kl, chi2, hellinger };

/// One threshold a channel of the estimator; the rest is not looked at.
using Thresholds = std::array<float, 3>;

/// One row of the table of error estimators: everything the program knows about one. Combo boxes,
/// command line, file headers and tests walk the table.
struct Estimator {
  EstimatorId key;
  std::string_view id;                ///< on the command line and in files
  std::string_view label;             ///< for people
  std::string_view unit;              ///< of the error and its thresholds
  std::string_view source;            ///< of the formula
  std::string_view threshold_source;  ///< of the default thresholds
  /// Errors a pixel: 3 (R, G, B), 1, or 0 for a method that never asks for more.
  int channels;
  Thresholds default_thresholds;
  /// Writes the raw error of every pixel, channel by channel (channels × film.size()). Null where
  /// channels is 0. Runs on the threads of the current TBB arena.
  void (*estimate)(const Film& film, std::span<float> error);
};

std::span<const Estimator> estimators();
const Estimator& estimator(EstimatorId key);
/// Throws std::invalid_argument that lists the legal ids.
const Estimator& find_estimator(std::string_view id);

}  // namespace quartet
