#pragma once

#include <string>

#include "app/options/run_options.h"
#include "renderer/study/versus.h"

namespace quartet {

/// Everything that a comparison of two lanes is written with.
struct VersusReport {
  const Run& run;
  const VersusPlan& plan;
  const VersusResult& result;
  double confidence = 0.95;  ///< of all intervals together
  double noise_floor = 0.0;  ///< of MSE, of the reference; NaN: not known
  std::string command_line;

  /// Ratios of all metrics and energies of both lanes are one family.
  double each_rate() const;
};

/// A table of both lanes, the ratios of their errors, and the finding in a sentence, which speaks
/// of the first metric.
std::string versus_text(const VersusReport& report);
std::string versus_json(const VersusReport& report);
/// Long form, see csv_header: every pass of each lane with each seed, and where both are compared,
/// as metrics with "_at_goal" behind them.
std::string versus_csv(const VersusReport& report);

}  // namespace quartet
