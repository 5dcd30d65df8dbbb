#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "renderer/study/claims.h"

// The findings of the 2021 report as rules. The report states them in words about pictures: what
// "most", "evenly" or "few" mean in numbers is decided here, once and for all criteria.

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

/// Judges conditions of one finding.
class Judge {
 public:
  Judge(const ClaimData& data, int number, std::string text) : data_(data) {
    claim_.number = number;
    claim_.text = std::move(text);
  }

  template <class Value>
  void above(double limit, std::string what, const Value& value) {
    check(fmt::format("{} > {:g}", what, limit), value, [limit](const Interval& interval) {
      return interval.low > limit    ? ClaimVerdict::holds
             : interval.high < limit ? ClaimVerdict::does_not_hold
                                     : ClaimVerdict::undecided;
    });
  }

  template <class Value>
  void below(double limit, std::string what, const Value& value) {
    check(fmt::format("{} < {:g}", what, limit), value, [limit](const Interval& interval) {
      return interval.high < limit  ? ClaimVerdict::holds
             : interval.low > limit ? ClaimVerdict::does_not_hold
                                    : ClaimVerdict::undecided;
    });
  }

  template <class Value>
  void within(double low, double high, std::string what, const Value& value) {
    check(fmt::format("{} from {:g} to {:g}", what, low, high), value,
          [low, high](const Interval& interval) {
            return interval.low > low && interval.high < high   ? ClaimVerdict::holds
                   : interval.high < low || interval.low > high ? ClaimVerdict::does_not_hold
                                                                : ClaimVerdict::undecided;
          });
  }

  Claim take() {
    const auto is = [](ClaimVerdict verdict) {
      return [verdict](const ClaimCheck& check) { return check.verdict == verdict; };
    };
    claim_.verdict = std::ranges::any_of(claim_.checks, is(ClaimVerdict::does_not_hold))
                         ? ClaimVerdict::does_not_hold
                     : std::ranges::all_of(claim_.checks, is(ClaimVerdict::holds))
                         ? ClaimVerdict::holds
                         : ClaimVerdict::undecided;
    return std::move(claim_);
  }

 private:
  template <class Value, class Rule>
  void check(std::string text, const Value& value, const Rule& rule) {
    const Interval interval = over_seeds(data_, value);
    claim_.checks.push_back({std::move(text), interval, rule(interval)});
  }

  const ClaimData& data_;
  Claim claim_;
};

Claim ceiling_and_shadow(const ClaimData& data) {
  Judge judge(data, 1,
              "Contrast puts most of its samples on the ceiling and into the glass ball's shadow "
              "and caustic; the f-divergences do not.");
  // "Most": at least a quarter more than the mean lit pixel gets; the others not more than it.
  constexpr double many = 1.25;
  for (const RegionId id : {RegionId::ceiling, RegionId::ball_shadow}) {
    judge.above(many, fmt::format("contrast: {} / mean lit pixel", region(id).id),
                [id](const ClaimSeed& seed) { return density(seed, contrast, id); });
    for (const std::size_t c : divergences) {
      judge.below(1.0, fmt::format("{}: {} / mean lit pixel", name_of(c), region(id).id),
                  [id, c](const ClaimSeed& seed) { return density(seed, c, id); });
    }
  }
  return judge.take();
}

Claim checkerboard(const ClaimData& data) {
  Judge judge(data, 2,
              "The f-divergences work around the brighter areas of the checkerboard; contrast "
              "samples the checkerboard's borders evenly.");
  constexpr double brighter = 1.1;
  for (const std::size_t c : divergences) {
    judge.above(
        brighter, fmt::format("{}: bright / dark squares", name_of(c)), [c](const ClaimSeed& seed) {
          return spp(seed, c, RegionId::bright_squares) / spp(seed, c, RegionId::dark_squares);
        });
  }
  // "Evenly": the two sides of a border alike, to a tenth, and both more than the squares.
  judge.within(0.9, 1.1, "contrast: bright / dark side of borders", [](const ClaimSeed& seed) {
    return spp(seed, contrast, RegionId::bright_borders) /
           spp(seed, contrast, RegionId::dark_borders);
  });
  for (const auto& [border, square] :
       {std::pair{RegionId::bright_borders, RegionId::bright_squares},
        {RegionId::dark_borders, RegionId::dark_squares}}) {
    judge.above(brighter, fmt::format("contrast: {} / {}", region(border).id, region(square).id),
                [border = border, square = square](const ClaimSeed& seed) {
                  return spp(seed, contrast, border) / spp(seed, contrast, square);
                });
  }
  return judge.take();
}

Claim alike(const ClaimData& data) {
  Judge judge(data, 3, "The three f-divergences look alike; Hellinger at 0.003 spends the least.");
  judge.above(0.9, "lowest correlation of samples a pixel between two of them",
              [](const ClaimSeed& seed) { return seed.lowest_correlation; });
  for (const std::size_t c : divergences) {
    if (c != hellinger) {
      judge.below(1.0, fmt::format("hellinger / {}: mean spp", name_of(c)),
                  [c](const ClaimSeed& seed) {
                    return seed.runs[hellinger].mean_spp / seed.runs[c].mean_spp;
                  });
    }
  }
  return judge.take();
}

Claim few(const ClaimData& data) {
  Judge judge(data, 4,
              "The front of the white box, the green and red walls away from edges, and the black "
              "margins get few samples under all four.");
  // "Few": at least a tenth less than the mean lit pixel gets.
  constexpr double fewer = 0.9;
  for (const RegionId id :
       {RegionId::box_front, RegionId::green_wall, RegionId::red_wall, RegionId::margin}) {
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      judge.below(fewer, fmt::format("{}: {} / mean lit pixel", name_of(c), region(id).id),
                  [id, c](const ClaimSeed& seed) { return density(seed, c, id); });
    }
  }
  return judge.take();
}

Claim firefly(const ClaimData& data) {
  Judge judge(data, 5, "A firefly draws samples to its whole neighbourhood.");
  for (std::size_t c = 0; c < report_criterion_count; ++c) {
    judge.above(0.0,
                fmt::format("{}: samples next pass, a neighbour minus a pixel 4 away", name_of(c)),
                [c](const ClaimSeed& seed) {
                  const FireflyResponse& response = seed.runs[c].firefly;
                  return response.nearby - response.further;
                });
  }
  return judge.take();
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
  return {ceiling_and_shadow(data), checkerboard(data), alike(data), few(data), firefly(data)};
}

}  // namespace quartet
