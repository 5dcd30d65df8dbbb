#pragma once

#include <optional>

#include "renderer/adaptive/effort.h"
#include "renderer/session/snapshot.h"
#include "renderer/view/chart.h"

namespace quartet {

/// How far each lane has come against the reference and what uniform sampling does instead.
struct EffortChart {
  Effort effort = Effort::seconds;
  std::optional<double> noise_floor;  ///< of the reference, in the snapshot's metric
};

/// Error over effort, log–log: a line a lane (id: its number) that looks as its estimator does
/// everywhere, dotted if another lane before it has the same one, the uniform baseline as far as it
/// was measured, and the noise floor.
/// Of decibels the vertical axis is linear. Empty, with a text that says so, for a snapshot without
/// errors.
Chart effort_chart(const Snapshot& snapshot, const EffortChart& what);

/// What uniform sampling reaches with this much effort: measured points are joined by straight
/// lines in log–log. None before the first and beyond the last one, and for decibels.
std::optional<double> baseline_error(const Snapshot& snapshot, Effort effort, double at);

/// How many times uniform sampling's error, at the same effort, is that of a lane. None without
/// either.
std::optional<double> times_uniform(const Snapshot& snapshot, std::size_t lane, Effort effort);

}  // namespace quartet
