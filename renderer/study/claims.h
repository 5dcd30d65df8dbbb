#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/interval.h"
#include "renderer/measure/rejected_count.h"
#include "renderer/study/regions.h"
#include "renderer/study/sample_world.h"

namespace quartet {

/// The four estimators of the 2021 report, in its order.
inline constexpr std::array report_criteria{EstimatorId::contrast, EstimatorId::kl,
                                            EstimatorId::chi2, EstimatorId::hellinger};
inline constexpr std::size_t report_criterion_count = report_criteria.size();

/// What one firefly draws: samples that the pass after it gives, in the mean over all fireflies.
struct FireflyResponse {
  std::uint64_t fireflies = 0;
  double nearby = 0.0;   ///< a pixel of its 8 neighbours
  double further = 0.0;  ///< a pixel at distance 4: beyond any window that saw it
};

/// One criterion after the report's passes, with one seed.
struct ClaimRun {
  std::vector<double> spp;    ///< mean samples per pixel of each region, in the table's order
  std::vector<double> share;  ///< of all samples
  double mean_spp = 0.0;
  double lit_spp = 0.0;  ///< the mean over all pixels but the black margin
  double seconds = 0.0;  ///< as if alone
  double relmse = 0.0;
  double relmse_top = 0.0;  ///< relmse_top_share()
  double flip = 0.0;
  double energy = 0.0;          ///< energy_error(): a gain may be light that was lost
  double uniform_relmse = 0.0;  ///< of uniform sampling after as many seconds, with the same seed
  double uniform_flip = 0.0;
  FireflyResponse firefly;
};

/// All criteria with one seed, and how alike the maps of samples of the f-divergences are.
struct ClaimSeed {
  std::array<ClaimRun, report_criterion_count> runs;
  // Of samples a pixel:
  double lowest_correlation = 0.0;     ///< between two of the three divergences
  double highest_with_contrast = 0.0;  ///< between contrast and one of them
};

struct ClaimData {
  std::vector<std::size_t> pixels;  ///< of each region
  std::vector<ClaimSeed> seeds;
  RejectedCount rejected;  ///< of the run that met most
  bool partial = false;    ///< memory was short: some samples were traced again
};

/// The weights of red, green and blue in luminance that the report used: of NTSC's phosphors.
inline constexpr glm::vec3 report_weights{0.299f, 0.587f, 0.114f};

/// Renders the report's scene as the report did, with its weights, at several seeds. Nothing if
/// `stop` ended it. Throws std::runtime_error if the scene is not the report's.
std::optional<ClaimData> measure_claims(
    const SampleWorld& world, const std::vector<RegionId>& region_of_pixel, std::uint32_t passes,
    std::uint32_t seeds, std::stop_token stop,
    const std::function<void(double, std::string_view)>& progress);

/// A value of each seed, with the interval of its mean at confidence 1 − p.
Interval over_seeds(const ClaimData& data, const std::function<double(const ClaimSeed&)>& value,
                    double p = 0.05);

enum class ClaimVerdict { holds, does_not_hold, undecided };
std::string_view verdict_text(ClaimVerdict verdict);

/// One condition of a finding: a number that must lie on one side of a limit.
struct ClaimCheck {
  std::string text;  ///< what is compared, with the limit
  Interval value;
  ClaimVerdict verdict =
      ClaimVerdict::undecided;  ///< undecided: the limit lies inside the interval
};

/// A finding of the report as a rule: it holds if all of its conditions do, and does not if one of
/// them does not.
struct Claim {
  int number = 0;      ///< of the list of findings
  bool added = false;  ///< what the report does not say, beside the finding of that number
  std::string text;
  std::vector<ClaimCheck> checks;
  ClaimVerdict verdict = ClaimVerdict::undecided;
};

/// The five findings, in the report's words, then what is added to them. Intervals over the seeds
/// hold with 95 % confidence all together (Šidák 1967).
std::vector<Claim> judge_claims(const ClaimData& data);

/// Error over that of uniform sampling at equal as-if-alone time, a criterion: below 1 it beats
/// uniform. The interval is that of the geometric mean over the seeds.
Interval against_uniform(const ClaimData& data, std::size_t criterion, MetricId metric);

}  // namespace quartet
