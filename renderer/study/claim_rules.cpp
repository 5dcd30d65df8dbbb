#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "renderer/study/claims.h"

// The findings of the 2021 report as rules. The report states them in words about pictures, which
// compare criteria, or parts of a picture; so do the rules, and no limit stands in them that the
// report has not given.

namespace quartet {
namespace {

constexpr std::size_t contrast = 0;
constexpr std::array<std::size_t, 3> divergences{1, 2, 3};
constexpr std::size_t hellinger = 3;

std::string_view name_of(std::size_t criterion) {
  return estimator(report_criteria[criterion]).id;
}

double spp(const ClaimSeed& seed, std::size_t criterion, RegionId id) {
  return seed.runs[criterion].spp[std::size_t(&region(id) - regions().data())];
}

/// Samples a pixel of a region over those of the mean lit pixel.
double density(const ClaimSeed& seed, std::size_t criterion, RegionId id) {
  return spp(seed, criterion, id) / seed.runs[criterion].lit_spp;
}

using SeedValue = std::function<double(const ClaimSeed&)>;

/// A number of each seed that must lie above a limit, or below it.
struct Condition {
  std::string text;
  SeedValue value;
  bool above;
  double limit;
};

struct ClaimRule {
  int number;
  bool added;
  std::string text;
  std::vector<Condition> conditions;

  void above(double limit, const std::string& what, SeedValue value) {
    conditions.push_back({fmt::format("{} > {:g}", what, limit), std::move(value), true, limit});
  }
  void below(double limit, const std::string& what, SeedValue value) {
    conditions.push_back({fmt::format("{} < {:g}", what, limit), std::move(value), false, limit});
  }
};

/// That contrast prefers a region, and more so than each of the divergences.
void prefers(ClaimRule& finding, RegionId id) {
  finding.above(1.0, fmt::format("contrast: {} / mean lit pixel", region(id).id),
                [id](const ClaimSeed& seed) { return density(seed, contrast, id); });
  for (const std::size_t c : divergences) {
    finding.above(1.0, fmt::format("contrast / {}: {} / mean pixel", name_of(c), region(id).id),
                  [id, c](const ClaimSeed& seed) {
                    return spp(seed, contrast, id) / seed.runs[contrast].mean_spp /
                           (spp(seed, c, id) / seed.runs[c].mean_spp);
                  });
  }
}

ClaimRule ceiling() {
  ClaimRule finding{1,
                    false,
                    "Contrast puts most of its samples on the indirectly lit ceiling; the "
                    "f-divergences do not.",
                    {}};
  prefers(finding, RegionId::ceiling);
  return finding;
}

ClaimRule shadow() {
  ClaimRule finding{1,
                    true,
                    "Contrast puts many samples into the glass ball's shadow and caustic; the "
                    "f-divergences do not.",
                    {}};
  prefers(finding, RegionId::ball_shadow);
  return finding;
}

double bright_over_dark(const ClaimSeed& seed, std::size_t criterion) {
  return spp(seed, criterion, RegionId::bright_squares) /
         spp(seed, criterion, RegionId::dark_squares);
}

/// How far the two sides of a border are from alike.
double unevenness(const ClaimSeed& seed, std::size_t criterion) {
  return std::abs(std::log(spp(seed, criterion, RegionId::bright_borders) /
                           spp(seed, criterion, RegionId::dark_borders)));
}

ClaimRule checkerboard() {
  ClaimRule finding{2,
                    false,
                    "The f-divergences work mostly around the brighter areas of the checkerboard; "
                    "contrast samples the checkerboard's borders evenly.",
                    {}};
  for (const std::size_t c : divergences) {
    finding.above(1.0, fmt::format("{} / contrast: bright / dark squares", name_of(c)),
                  [c](const ClaimSeed& seed) {
                    return bright_over_dark(seed, c) / bright_over_dark(seed, contrast);
                  });
    finding.below(
        0.0, fmt::format("contrast - {}: |log| of bright / dark side of borders", name_of(c)),
        [c](const ClaimSeed& seed) { return unevenness(seed, contrast) - unevenness(seed, c); });
  }
  for (const auto& [border, square] :
       {std::pair{RegionId::bright_borders, RegionId::bright_squares},
        {RegionId::dark_borders, RegionId::dark_squares}}) {
    finding.above(1.0, fmt::format("contrast: {} / {}", region(border).id, region(square).id),
                  [border = border, square = square](const ClaimSeed& seed) {
                    return spp(seed, contrast, border) / spp(seed, contrast, square);
                  });
  }
  return finding;
}

ClaimRule alike() {
  ClaimRule finding{
      3, false, "The three f-divergences look alike; Hellinger at 0.003 spends the least.", {}};
  finding.above(
      0.0, "correlation of samples a pixel: lowest of two divergences - highest with contrast",
      [](const ClaimSeed& seed) { return seed.lowest_correlation - seed.highest_with_contrast; });
  for (const std::size_t c : divergences) {
    if (c != hellinger) {
      finding.below(1.0, fmt::format("hellinger / {}: mean spp", name_of(c)),
                    [c](const ClaimSeed& seed) {
                      return seed.runs[hellinger].mean_spp / seed.runs[c].mean_spp;
                    });
    }
  }
  return finding;
}

ClaimRule few() {
  ClaimRule finding{4,
                    false,
                    "The front of the white box, the green and red walls away from edges, and the "
                    "black margins get few samples under all four.",
                    {}};
  for (const RegionId id :
       {RegionId::box_front, RegionId::green_wall, RegionId::red_wall, RegionId::margin}) {
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      finding.below(1.0, fmt::format("{}: {} / mean lit pixel", name_of(c), region(id).id),
                    [id, c](const ClaimSeed& seed) { return density(seed, c, id); });
    }
  }
  return finding;
}

ClaimRule firefly() {
  ClaimRule finding{5, false, "A firefly draws samples to its whole neighbourhood.", {}};
  for (std::size_t c = 0; c < report_criterion_count; ++c) {
    finding.above(
        0.0, fmt::format("{}: samples next pass, a neighbour minus a pixel 4 away", name_of(c)),
        [c](const ClaimSeed& seed) {
          const FireflyResponse& response = seed.runs[c].firefly;
          return response.nearby - response.further;
        });
  }
  return finding;
}

ClaimVerdict verdict_of(const Condition& condition, const Interval& interval) {
  const bool is_above = interval.low > condition.limit;
  const bool is_below = interval.high < condition.limit;
  if (!is_above && !is_below) {
    return ClaimVerdict::undecided;
  }
  return is_above == condition.above ? ClaimVerdict::holds : ClaimVerdict::does_not_hold;
}

ClaimVerdict verdict_of(const std::vector<ClaimCheck>& checks) {
  const auto is = [](ClaimVerdict verdict) {
    return [verdict](const ClaimCheck& check) { return check.verdict == verdict; };
  };
  return std::ranges::any_of(checks, is(ClaimVerdict::does_not_hold)) ? ClaimVerdict::does_not_hold
         : std::ranges::all_of(checks, is(ClaimVerdict::holds))       ? ClaimVerdict::holds
                                                                      : ClaimVerdict::undecided;
}

}  // namespace

std::string_view verdict_text(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::holds:
      return "holds";
    case ClaimVerdict::does_not_hold:
      return "does not hold";
    case ClaimVerdict::undecided:
      break;
  }
  return "undecided";
}

std::vector<Claim> judge_claims(const ClaimData& data) {
  const std::array findings{ceiling(), checkerboard(), alike(), few(), firefly(), shadow()};
  std::size_t conditions = 0;
  for (const ClaimRule& finding : findings) {
    conditions += finding.conditions.size();
  }
  const double p = sidak(0.05, double(conditions));
  std::vector<Claim> claims;
  for (const ClaimRule& finding : findings) {
    Claim claim{finding.number, finding.added, finding.text, {}, ClaimVerdict::undecided};
    for (const Condition& condition : finding.conditions) {
      const Interval interval = over_seeds(data, condition.value, p);
      claim.checks.push_back({condition.text, interval, verdict_of(condition, interval)});
    }
    claim.verdict = verdict_of(claim.checks);
    claims.push_back(std::move(claim));
  }
  return claims;
}

}  // namespace quartet
