#include "renderer/view/ticks.h"
#include "renderer/base/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace quartet {
namespace {

std::string labels(const std::vector<Tick>& ticks) {
  std::string text;
  for (const Tick& tick : ticks) {
    text += (text.empty() ? "" : " ") + tick.label;
  }
  return text;
}

TEST(Ticks, AreRoundNumbersInsideTheRange) {
  EXPECT_EQ(labels(linear_ticks(0, 71, 4)), "0 20 40 60");
  EXPECT_EQ(labels(linear_ticks(0, 1, 5)), "0.0 0.2 0.4 0.6 0.8 1.0");
  EXPECT_EQ(labels(linear_ticks(-0.3, 0.3, 6)), "-0.3 -0.2 -0.1 0.0 0.1 0.2 0.3");
  EXPECT_EQ(labels(linear_ticks(8, 12, 4)), "8 9 10 11 12");
  EXPECT_EQ(labels(linear_ticks(0, 0.05, 5)), "0.00 0.01 0.02 0.03 0.04 0.05");
  EXPECT_EQ(labels(linear_ticks(0, 3e6, 3)), "0 1e6 2e6 3e6");
  EXPECT_EQ(labels(linear_ticks(0, 2e-5, 2)), "0 1e-5 2e-5");
}

TEST(Ticks, StayInRangeAndNearTheWantedNumber) {
  for (double max = 1e-8; max < 1e9; max *= 1.37) {
    for (const double min : {0.0, 0.4 * max, -max}) {
      const auto ticks = linear_ticks(min, max, 6);
      EXPECT_GE(ticks.size(), 2u) << min << ' ' << max;
      EXPECT_LE(ticks.size(), 10u) << min << ' ' << max;
      for (const Tick& tick : ticks) {
        EXPECT_GE(tick.value, min - 1e-8 * max);
        EXPECT_LE(tick.value, max + 1e-8 * max);
        EXPECT_NEAR(std::stod(tick.label), tick.value, 1e-3 * max);
      }
    }
  }
}

TEST(Ticks, WithEndsHaveBothEndsAndRoomBetween) {
  EXPECT_EQ(labels(ticks_with_ends(0, 71, 7)), "0 10 20 30 40 50 60 71");
  EXPECT_EQ(labels(ticks_with_ends(8, 71, 4)), "8 20 40 60 71");
  EXPECT_EQ(labels(ticks_with_ends(19, 62, 3)), "19 30 40 50 62");
  EXPECT_EQ(labels(ticks_with_ends(0, 1, 2)), "0.0 0.5 1.0");
  EXPECT_EQ(labels(ticks_with_ends(0.55, 0.95, 1)), "0.55 0.95");
  EXPECT_EQ(labels(ticks_with_ends(-0.35, 0.35, 2)), "-0.35 0.0 0.35");
}

TEST(Ticks, OfOddRanges) {
  EXPECT_EQ(labels(linear_ticks(5, 5, 4)), "5");
  EXPECT_EQ(labels(ticks_with_ends(5, 5, 4)), "5");
  EXPECT_TRUE(linear_ticks(1, 0, 4).empty());
  EXPECT_TRUE(linear_ticks(0, std::numeric_limits<double>::infinity(), 4).empty());
  EXPECT_TRUE(ticks_with_ends(std::nan(""), 1, 4).empty());
  EXPECT_LE(linear_ticks(1e16, 1e16 + 4, 4).size(), 5u);
}

TEST(FormatNumber, HasFourDigitsAndNoMore) {
  EXPECT_EQ(format_number(71), "71");
  EXPECT_EQ(format_number(0.005), "0.005");
  EXPECT_EQ(format_number(31.2749), "31.27");
  EXPECT_EQ(format_number(-0.0), "0");
  EXPECT_EQ(format_number(12345678), "1.235e7");
  EXPECT_EQ(format_number(1.5e-7), "1.5e-7");
}

TEST(LogTicks, AreOneTwoFiveOrPowersOfTenAsRoomAllows) {
  EXPECT_EQ(labels(log_ticks(0.1, 50.0, 9)), "0.1 0.2 0.5 1 2 5 10 20 50");
  EXPECT_EQ(labels(log_ticks(0.1, 50.0, 5)), "0.1 1 10");
  EXPECT_EQ(labels(log_ticks(2e-5, 0.02, 10)),
            "2·10⁻⁵ 5·10⁻⁵ 10⁻⁴ 2·10⁻⁴ 5·10⁻⁴ 10⁻³ 2·10⁻³ 5·10⁻³ 0.01 0.02");
  EXPECT_EQ(labels(log_ticks(1e-8, 1e4, 7)), "10⁻⁸ 10⁻⁶ 10⁻⁴ 0.01 1 100 10⁴");
  EXPECT_EQ(labels(log_ticks(3.0, 4.5, 3)), "3.0 3.5 4.0 4.5");
  EXPECT_EQ(labels(log_ticks(0.0, 1.0, 5)), "");
  EXPECT_EQ(labels(log_ticks(1.0, std::numeric_limits<double>::infinity(), 5)), "");
}

TEST(LogTicks, StayInRangeAndNearTheWantedNumber) {
  for (double min = 1.3e-9; min < 1e6; min *= 7.7) {
    for (double ratio = 1.5; ratio < 1e12; ratio *= 3.1) {
      const std::vector<Tick> ticks = log_ticks(min, min * ratio, 6);
      EXPECT_GE(ticks.size(), 2u) << min << ' ' << ratio;
      EXPECT_LE(ticks.size(), 9u) << min << ' ' << ratio;
      for (const Tick& tick : ticks) {
        EXPECT_GE(tick.value, min * (1 - 1e-6));
        EXPECT_LE(tick.value, min * ratio * (1 + 1e-6));
      }
    }
  }
}

}  // namespace
}  // namespace quartet
