#pragma once

#include <string>

#include "renderer/image/staged_files.h"
#include "renderer/measure/verdict.h"

namespace quartet {

/// matrix.png and matrix.pdf, the verdict of every estimator in every case; stability.csv, every
/// number behind them with its interval; trials.csv, every number of every seed. Long form: one row
/// a number.
void write_stability_files(StagedFiles& files, const StabilityOptions& options,
                           std::span<const CaseResult> results, const StabilitySummary& summary,
                           const std::string& command_line);

}  // namespace quartet
