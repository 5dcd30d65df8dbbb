#include <array>

#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/plan_parts.h"
#include "renderer/adaptive/policies/policy_rows.h"

namespace quartet {
namespace {

/// A uniform number in [0, 1) that belongs to (pixel, pass).
float dither(std::uint32_t pixel, std::uint32_t pass) {
  std::uint32_t x = pixel * 0x9e3779b9u + pass * 0x85ebca6bu;
  x ^= x >> 16;
  x *= 0x21f0aaadu;
  x ^= x >> 15;
  x *= 0x735a2d97u;
  x ^= x >> 15;
  return float(x >> 8) * 0x1p-24f;
}

std::uint16_t first_of_vote(const Policy& /*policy*/) {
  return 1;
}

/// The policy of the 2021 report: every pixel that is not done votes for itself and its up to
/// eight neighbours, and a pixel gets one sample and then ⌊multiplier · votes⌋ more.
void plan_vote(const LaneSettings& settings, const PlanRow& row, std::uint16_t* wanted) {
  const float multiplier = settings.policy.multiplier;
  // Through int, for which there are vectors; it rounds down because no term is negative.
  const auto plan = [&](const auto& offset_of) {
#pragma omp simd
    for (std::size_t x = 0; x < row.width; ++x) {
      wanted[x] = std::uint16_t(1 + int(multiplier * float(votes_of(row, x)) + offset_of(x)));
    }
  };
  if (settings.policy.stochastic_rounding) {
    plan([&](std::size_t x) { return dither(row.first_pixel + std::uint32_t(x), row.pass); });
  } else {
    plan([](std::size_t) { return 0.0f; });
  }
}

constexpr std::array vote_parameters{PolicyParameterId::multiplier,
                                     PolicyParameterId::stochastic_rounding};

static_assert(Policy().multiplier == 0.5f, "the help says so");

}  // namespace

constexpr PolicyParameter multiplier_parameter{
    .key = PolicyParameterId::multiplier,
    .id = "multiplier",
    .word = "multiplier",
    .label = "×",
    .help =
        "extra samples for each vote, 0.5 if not given; 1 is the text of the 2021 report, 0.5 "
        "its pictures",
    .tooltip =
        "Extra samples for each vote, rounded down. 1 is the text of the 2021 report, 0.5 "
        "its pictures.",
    .value = RealParameter{&Policy::multiplier, 0.0f, 1000.0f, 2.0f}};

constexpr PolicyParameter stochastic_rounding_parameter{
    .key = PolicyParameterId::stochastic_rounding,
    .id = "stochastic_rounding",
    .word = "stochastic-rounding",
    .label = "round at random",
    .help = "round multiplier x votes at random instead of down",
    .tooltip =
        "Round multiplier × votes up or down at random, so that its mean is kept, rather "
        "than down as the report does.",
    .value = FlagParameter{&Policy::stochastic_rounding}};

constexpr PolicyRow vote_policy{.key = PolicyId::vote,
                                .id = "vote",
                                .label = "vote",
                                .source = "the 2021 course report",
                                .parameters = vote_parameters,
                                .first = first_of_vote,
                                .plan = plan_vote};

}  // namespace quartet
