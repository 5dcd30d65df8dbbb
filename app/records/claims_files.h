#pragma once

#include <string>

#include "app/options/run_options.h"
#include "renderer/study/claims.h"

namespace quartet {

/// What the report's claims are written with.
struct ClaimsReport {
  const Run& run;
  const ClaimData& data;
  std::uint32_t passes = 15;
  std::uint64_t reference_spp = 0;
  std::string command_line;
};

/// The tables and verdicts for people.
std::string claims_text(const ClaimsReport& report);
std::string claims_json(const ClaimsReport& report);
/// scene, criterion, region, pixels, quantity, mean, low, high: of each region its mean_spp and
/// share of the samples; of the whole picture (region "all") the cost, the errors, and both against
/// uniform sampling at equal time; low and high are the ends of 95 % intervals over the seeds.
std::string claims_csv(const ClaimsReport& report);

}  // namespace quartet
