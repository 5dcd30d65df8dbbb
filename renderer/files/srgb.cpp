#include "renderer/files/srgb.h"

#include <cassert>
#include <cmath>

namespace quartet {

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

namespace {

/// The smallest float that is encoded as `value` or more. Positive floats are ordered as their
/// bits are.
std::uint32_t first_bits_of(int value) {
  std::uint32_t low = 0;
  auto high = std::bit_cast<std::uint32_t>(1.0f);
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (std::lround(255.0 * srgb_encode(std::bit_cast<float>(middle))) >= value) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

}  // namespace

Srgb8Encoder::Srgb8Encoder() {
  constexpr auto no_step = std::bit_cast<std::uint32_t>(2.0f);
  parts_.fill({no_step, 0});
  for (int value = 1; value <= 255; ++value) {
    const std::uint32_t bits = first_bits_of(value);
    Part& part = parts_.at((bits - lowest_bits) >> part_shift);
    assert(part.step == no_step);
    part.step = bits;
  }
  std::uint32_t below = 0;
  for (Part& part : parts_) {
    part.below = below;
    below += part.step != no_step ? 1 : 0;
  }
}

const Srgb8Encoder& srgb8_encoder() {
  static const Srgb8Encoder encoder;
  return encoder;
}

}  // namespace quartet
