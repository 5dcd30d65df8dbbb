#include "renderer/image/srgb.h"

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
  std::uint32_t high = std::bit_cast<std::uint32_t>(1.f);
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
  step_.fill(2.f);
  std::array<std::uint8_t, kParts> steps{};
  for (int value = 1; value <= 255; ++value) {
    const std::uint32_t bits = first_bits_of(value);
    const std::size_t part = (bits - std::bit_cast<std::uint32_t>(kLowest)) >> kPartShift;
    assert(part < kParts && steps[part] == 0);
    step_[part] = std::bit_cast<float>(bits);
    steps[part] = 1;
  }
  std::uint8_t below = 0;
  for (std::size_t part = 0; part < kParts; ++part) {
    below_[part] = below;
    below = static_cast<std::uint8_t>(below + steps[part]);
  }
}

const Srgb8Encoder& srgb8_encoder() {
  static const Srgb8Encoder encoder;
  return encoder;
}

}  // namespace quartet
