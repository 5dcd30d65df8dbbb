#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/base/math/hash_mix.h"

namespace quartet {

/// A number in [0, 1) that belongs to (pixel, seed), without regard to anything else of either.
constexpr double lot(std::size_t pixel, std::uint64_t seed) {
  return double(hash_mix(seed ^ ((pixel + 1) * golden_step)) >> 11) * 0x1p-53;
}

}  // namespace quartet
