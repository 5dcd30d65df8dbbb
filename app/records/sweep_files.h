#pragma once

#include <string>
#include <vector>

#include "app/options/run_options.h"
#include "renderer/files/staged_files.h"
#include "renderer/study/sweep_points.h"

namespace quartet {

/// The names of all that write_sweep_files writes.
inline std::vector<std::string> sweep_file_names() {
  return {"sweep.csv",       "sweep.json",      "sweep.png",       "sweep.pdf",
          "sweep.svg",       "thresholds.png",  "thresholds.pdf",  "thresholds.svg",
          "calibration.csv", "calibration.png", "calibration.pdf", "calibration.svg"};
}

/// Everything that a sweep is written with.
struct SweepReport {
  const Run& run;
  const SweepPlan& plan;
  const SweepResult& result;
  const SweepSummary& summary;   ///< of the result
  Effort effort = Effort::rays;  ///< that the charts are drawn over
  std::uint64_t reference_spp = 0;
  std::string command_line;
};

/// Long form, one row a measurement: see csv_header. Of each run the passes that were measured, and
/// of its end every metric and the quality of its estimator (rank_correlation, false_stops,
/// oracle_distance; a row less where there is no such number); of the uniform baseline the passes
/// that were measured. Last, with seed "all", what the seeds together say of each line: metric and
/// energy_error with "_low" and "_high" behind them, the two parts of the metric ("_squared_bias",
/// "_variance"), and of ends its ratio to uniform sampling at equal effort ("_of_uniform_rays", …)
/// and the other metrics; pass is "end" where the seeds ended after different ones.
std::string sweep_csv(const SweepReport& report);

/// The calibration curves of all runs: scene, estimator, policy, mode, thresholds, seed,
/// estimated_error
/// (in units of the threshold), true_squared_error, pixels.
std::string calibration_csv(const SweepReport& report);

/// All of sweep_file_names(): sweep.csv, sweep.json, calibration.csv, and sweep, thresholds and
/// calibration as .png, .pdf and .svg.
void write_sweep_files(StagedFiles& files, const SweepReport& report);

}  // namespace quartet
