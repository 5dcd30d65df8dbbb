#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/adaptive/policies/policy.h"

namespace quartet {

// What plans are made of.

/// What most policies give a pixel at once: one round of the sampler's stratification.
inline constexpr std::uint16_t usual_batch = 8;

/// Of a parameter that is 0 where it is left to the policy.
inline std::uint16_t chosen_samples(std::uint16_t asked, std::uint16_t otherwise) {
  return asked > 0 ? asked : otherwise;
}

/// As many of a pixel and its up to eight neighbours as are not done.
inline int votes_of(const PlanRow& row, std::size_t x) {
  const auto three = [x](const std::uint8_t* marks) {
    return std::uint8_t(marks[std::ptrdiff_t(x) - 1] + marks[x] + marks[x + 1]);
  };
  return std::uint8_t(three(row.above) + three(row.here) + three(row.below));
}

/// As many samples for every pixel that is not done, none for the others.
inline void plan_not_done(const PlanRow& row, std::uint16_t samples, std::uint16_t* wanted) {
#pragma omp simd
  for (std::size_t x = 0; x < row.width; ++x) {
    wanted[x] = std::uint16_t(row.here[x] * samples);
  }
}

}  // namespace quartet
