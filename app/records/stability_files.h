#pragma once

#include <string>
#include <vector>

#include "renderer/files/staged_files.h"
#include "renderer/study/stability/stability_summary.h"

namespace quartet {

/// The names of all that write_stability_files writes.
inline std::vector<std::string> stability_file_names() {
  return {"matrix.png", "matrix.pdf", "stability.csv", "trials.csv"};
}

/// matrix.png and matrix.pdf, the verdict of every estimator in every case; stability.csv, every
/// number behind them with its interval; trials.csv, every number of every seed. Long form: one row
/// a number.
void write_stability_files(StagedFiles& files, const StabilityOptions& options,
                           std::span<const CaseResult> results, const StabilitySummary& summary,
                           const std::string& command_line);

}  // namespace quartet
