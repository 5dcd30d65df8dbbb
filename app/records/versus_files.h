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
  std::size_t metric = 0;    ///< of the plan, that the sentence speaks of
  double confidence = 0.95;  ///< of all intervals together
  double noise_floor = 0.0;  ///< of MSE, of the reference; NaN: not known
  std::string command_line;

  /// Ratios of all metrics and energies of both lanes are one family.
  double each_rate() const;
};

/// The finding in a sentence: which lane is better by how much, or that no difference was seen and
/// how large one could have been; and which of them has lost or gained light.
std::string versus_sentence(const VersusReport& report);

/// A table of both lanes, the ratios of their errors, and the sentence.
std::string versus_text(const VersusReport& report);
std::string versus_json(const VersusReport& report);
/// Long form, see csv_header: every pass of each lane with each seed, and where both are compared,
/// as metrics with "_at_goal" behind them.
std::string versus_csv(const VersusReport& report);

}  // namespace quartet
