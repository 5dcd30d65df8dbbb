#pragma once

#include <string>

#include "app/records/sweep_files.h"

namespace quartet {

/// One document: what was run, and every line of the sweep with its part in the comparison, its
/// trajectory and its end, each number with its interval over the seeds. What is not known is null.
std::string sweep_json(const SweepReport& report);

}  // namespace quartet
