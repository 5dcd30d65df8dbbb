#include "renderer/measure/error_parts.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "tests/trace/statistics.h"

namespace quartet {
namespace {

// Two numbers of three pictures: 1, 2, 3 and 4, 4, 7. Means 2 and 5, variances 1 and 3; bias² 4 and
// 25, less a third of the variances.
TEST(ErrorParts, OfThreePicturesByHand) {
  ErrorSums sums;
  sums.add(std::array{1.0f, 4.0f});
  EXPECT_TRUE(std::isnan(sums.parts().variance)) << "nobody knows of one picture";
  sums.add(std::array{2.0f, 4.0f});
  sums.add(std::array{3.0f, 7.0f});
  EXPECT_EQ(sums.pictures(), 3u);
  const ErrorParts parts = sums.parts();
  EXPECT_NEAR(parts.variance, 2.0, 1e-12);
  EXPECT_NEAR(parts.squared_bias, (4.0 - 1.0 / 3.0 + 25.0 - 1.0) / 2.0, 1e-12);
  // Both together are the mean of the pictures' errors.
  EXPECT_NEAR(parts.variance + parts.squared_bias, (1 + 4 + 9 + 16 + 16 + 49) / 6.0, 1e-12);
}

// 2000 studies of four pictures of ten numbers with bias 0 and variance 1: the mean of bias² has a
// standard error that is found from its spread; five of them, false alarms under 1e-6.
TEST(ErrorParts, OfPicturesWithoutBiasIsNoneInTheMean) {
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  test::Moments bias;
  test::Moments variance;
  for (int study = 0; study < 2000; ++study) {
    ErrorSums sums;
    for (int k = 0; k < 4; ++k) {
      std::array<float, 10> errors;
      for (float& error : errors) {
        error = normal(random);
      }
      sums.add(errors);
    }
    bias.add(sums.parts().squared_bias);
    variance.add(sums.parts().variance);
  }
  EXPECT_NEAR(bias.mean(), 0.0, 5.0 * bias.standard_error());
  EXPECT_LT(bias.standard_error(), 0.01);
  EXPECT_NEAR(variance.mean(), 1.0, 5.0 * variance.standard_error());
}

TEST(ErrorParts, OfEqualPicturesAreAllBias) {
  ErrorSums sums;
  for (int k = 0; k < 7; ++k) {
    sums.add(std::array{0.1f, 1e3f});
  }
  EXPECT_GE(sums.parts().variance, 0.0);
  EXPECT_NEAR(sums.parts().variance, 0.0, 0.1) << "rounding";
  EXPECT_NEAR(sums.parts().squared_bias, 5e5, 1.0);
}

}  // namespace
}  // namespace quartet
