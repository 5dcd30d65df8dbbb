#pragma once

#include <string>
#include <vector>

#include "app/options/run_options.h"
#include "renderer/files/staged_files.h"
#include "renderer/study/sweep.h"

namespace quartet {

/// The names of all that write_sweep_files writes.
inline std::vector<std::string> sweep_file_names() {
  return {"sweep.csv",       "sweep.png",       "sweep.pdf",       "sweep.svg",
          "calibration.csv", "calibration.png", "calibration.pdf", "calibration.svg"};
}

/// Everything that a sweep is written with.
struct SweepReport {
  const Run& run;
  const SweepPlan& plan;
  const SweepResult& result;
  double noise_floor = 0.0;  ///< of the reference in the first metric; NaN: not known
  std::uint64_t reference_spp = 0;
  std::string command_line;
};

/// Long form, one row a measurement: see csv_header. Of each run's end every metric and the quality
/// of its estimator (rank_correlation, false_stops, oracle_distance; a row less where there is no
/// such number); of the uniform baseline the passes that were measured.
std::string sweep_csv(const SweepReport& report);

/// The calibration curves of all runs: scene, estimator, policy, mode, thresholds, seed,
/// estimated_error
/// (in units of the threshold), true_squared_error, pixels.
std::string calibration_csv(const SweepReport& report);

/// sweep.csv, calibration.csv, and sweep and calibration as .png, .pdf and .svg.
void write_sweep_files(StagedFiles& files, const SweepReport& report);

}  // namespace quartet
