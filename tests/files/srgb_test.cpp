#include "renderer/files/srgb.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace quartet {
namespace {

int direct(float x) {
  return int(std::lround(255.0 * srgb_encode(x)));
}

TEST(Srgb, EncodeAndDecodeAreInverse) {
  for (int i = 0; i <= 1000; ++i) {
    const double x = i / 1000.0;
    EXPECT_NEAR(srgb_decode(srgb_encode(x)), x, 1e-7) << x;  // the standard's rounded constants
  }
  EXPECT_DOUBLE_EQ(srgb_encode(0.0), 0.0);
  EXPECT_NEAR(srgb_encode(1.0), 1.0, 1e-15);
  EXPECT_NEAR(srgb_encode(0.18), 0.461356, 1e-6);
}

TEST(Srgb8Encoder, EqualsTheFormulaOverAllOctaves) {
  const Srgb8Encoder& encode = srgb8_encoder();
  // Every 61st float from 0 to 1.
  const std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);
  int different = 0;
  for (std::uint32_t bits = std::bit_cast<std::uint32_t>(0x1p-16f); bits <= one; bits += 61) {
    const float x = std::bit_cast<float>(bits);
    different += encode(x) != direct(x);
  }
  EXPECT_EQ(different, 0);
}

TEST(Srgb8Encoder, EqualsTheFormulaAroundEveryStep) {
  const Srgb8Encoder& encode = srgb8_encoder();
  int different = 0;
  for (int value = 1; value <= 255; ++value) {
    const auto step = std::bit_cast<std::uint32_t>(float(srgb_decode((value - 0.5) / 255.0)));
    for (std::uint32_t bits = step - 1500; bits <= step + 1500; ++bits) {
      const float x = std::bit_cast<float>(bits);
      different += encode(x) != direct(x);
    }
  }
  EXPECT_EQ(different, 0);
}

TEST(Srgb8Encoder, EightBitValuesSurviveARoundTrip) {
  for (int value = 0; value <= 255; ++value) {
    EXPECT_EQ(srgb8_encoder()(float(srgb_decode(value / 255.0))), value);
  }
}

TEST(Srgb8Encoder, ClampsAndTakesNaNAsBlack) {
  const Srgb8Encoder& encode = srgb8_encoder();
  EXPECT_EQ(encode(0.0f), 0);
  EXPECT_EQ(encode(-0.0f), 0);
  EXPECT_EQ(encode(-5.0f), 0);
  EXPECT_EQ(encode(1.0f), 255);
  EXPECT_EQ(encode(7.0f), 255);
  EXPECT_EQ(encode(std::numeric_limits<float>::denorm_min()), 0);
  EXPECT_EQ(encode(std::numeric_limits<float>::infinity()), 255);
  EXPECT_EQ(encode(-std::numeric_limits<float>::infinity()), 0);
  EXPECT_EQ(encode(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace quartet
