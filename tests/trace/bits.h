#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace quartet {

/// The words of a value of floats and integers, to compare it to the bit: −0 is not 0, and a NaN is
/// itself.
template <class T>
std::array<std::uint32_t, sizeof(T) / sizeof(std::uint32_t)> bits(const T& value) {
  return std::bit_cast<std::array<std::uint32_t, sizeof(T) / sizeof(std::uint32_t)>>(value);
}

}  // namespace quartet
