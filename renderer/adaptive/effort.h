#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "renderer/adaptive/pass_history.h"

namespace quartet {

/// What a lane has spent: what errors are charted against, and what ends runs.
enum class Effort {
  seconds,
  rays,  ///< counted: the same on every machine
  mean_spp
};

/// One row of the table of efforts.
struct EffortRow {
  Effort key;
  std::string_view id;     ///< in files
  std::string_view label;  ///< for people, with the unit
  double (*of)(const PassRecord& record, std::size_t pixels);
};

std::span<const EffortRow> efforts();
const EffortRow& effort_row(Effort key);
/// Throws std::invalid_argument that lists the legal ids.
const EffortRow& find_effort(std::string_view id);

/// Samples a pixel has taken in the mean, those of a pilot run included.
double mean_spp(const PassRecord& record, std::size_t pixels);
/// Rays that a pixel's samples have taken in the mean, those of a pilot run included.
double mean_rays(const PassRecord& record, std::size_t pixels);

}  // namespace quartet
