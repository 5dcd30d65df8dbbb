#pragma once

#include <string>
#include <vector>

#include "app/options/run_options.h"
#include "renderer/files/staged_files.h"
#include "renderer/study/bias.h"

namespace quartet {

/// The names of all that write_bias_files writes.
inline std::vector<std::string> bias_file_names() {
  return {"bias.png", "bias.pdf", "bias.exr", "bias.csv"};
}

/// Everything that a measurement of bias is written with.
struct BiasReport {
  const Run& run;
  const std::vector<BiasRuns>& runs;
  std::uint32_t passes = 15;  ///< of each run
  double confidence = 0.99;   ///< of all intervals together
  std::string command_line;
};

/// How much more energy than uniform sampling, with its interval: "−0.588 % ± 0.590 %".
std::string energy_text(const BiasReport& report, const BiasRuns& runs);

/// bias.png and bias.pdf, the signed difference of each lane in each mode; bias.exr, the same in
/// numbers with their standard errors; bias.csv in long form, see csv_header: each seed, and the
/// mean over all with its interval.
void write_bias_files(StagedFiles& files, const BiasReport& report);

}  // namespace quartet
