#pragma once

#include <cstdint>

namespace quartet {

/// A bijection of 64 bits with every output bit depending on every input bit: the finaliser of
/// SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA
/// 2014), which is variant 13 of Stafford's for MurmurHash3. It need not withstand an adversary.
constexpr std::uint64_t hash_mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// What SplitMix64 adds from one number to the next: 2⁶⁴ over the golden ratio, odd.
inline constexpr std::uint64_t golden_step = 0x9e3779b97f4a7c15u;

}  // namespace quartet
