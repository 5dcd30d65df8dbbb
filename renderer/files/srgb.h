#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace quartet {

/// The sRGB transfer functions of IEC 61966-2-1:1999, for values in [0, 1].
double srgb_encode(double linear);
double srgb_decode(double encoded);

/// Linear light to an 8-bit sRGB value: round(255 srgb_encode(x)) exactly, without a pow.
///
/// The result is a step function of x with 255 steps. Cut into 128 equal parts per octave, no part
/// holds more than one step: one look-up and one comparison give the exact value.
class Srgb8Encoder {
 public:
  Srgb8Encoder();

  /// Values outside [0, 1] are clamped; NaN gives 0.
  std::uint8_t operator()(float linear) const { return look_up(clamped_bits(linear)); }

  /// The two halves of operator(): a loop over the first one vectorises, which is worth a factor
  /// of two for a whole image.
  static std::uint32_t clamped_bits(float linear) {
    const float above = linear > lowest ? linear : lowest;  // false for NaN
    return std::bit_cast<std::uint32_t>(above < highest ? above : highest);
  }
  std::uint8_t look_up(std::uint32_t bits) const {
    const Part& part = parts_[(bits - lowest_bits) >> part_shift];
    return std::uint8_t(part.below + (bits >= part.step ? 1u : 0u));
  }

 private:
  struct Part {
    std::uint32_t step;   // bits of the first float of the next value; floats > 0 order as bits do
    std::uint32_t below;  // the value up to there
  };

  static constexpr float lowest = 0x1p-13f;         // below the first step, 0.5/255/12.92
  static constexpr float highest = 0x1.fffffep-1f;  // above the last step
  static constexpr auto lowest_bits = std::bit_cast<std::uint32_t>(lowest);
  static constexpr int part_shift = 23 - 7;              // a part is 2^-7 of an octave
  static constexpr std::size_t part_count = 13UL * 128;  // 13 octaves from 2^-13 to 1

  std::array<Part, part_count> parts_;
};

/// The one encoder of the process. Take the reference once, outside of loops.
const Srgb8Encoder& srgb8_encoder();

}  // namespace quartet
