#include "renderer/measure/top_share.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace quartet {
namespace {

TEST(TopShare, IsThatOfTheSortedSum) {
  std::mt19937 random(3);
  std::exponential_distribution<float> exponential(1.0f);
  for (const std::size_t count : {1, 2, 7, 999, 1000, 1001, 2000, 12345}) {
    std::vector<float> errors(count);
    for (float& error : errors) {
      error = std::pow(exponential(random), 4.0f);
    }
    std::vector<float> sorted = errors;
    std::ranges::sort(sorted);
    std::ranges::reverse(sorted);
    double all = 0.0;
    double top = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      all += double(sorted[i]);
      top += 1000 * i < count ? double(sorted[i]) : 0.0;
    }
    EXPECT_NEAR(top_share(errors), top / all, 1e-12) << count;
  }
}

// Errors n, n − 1, … 1: the top k have k (2n − k + 1)/2 of n (n + 1)/2.
TEST(TopShare, OfARampHasAClosedForm) {
  std::vector<float> errors(5000);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    errors[i] = float((i * 1237) % errors.size() + 1);
  }
  EXPECT_NEAR(top_share(errors), 5.0 * (2.0 * 5000.0 - 4.0) / (5000.0 * 5001.0), 1e-12);
}

TEST(TopShare, OfEqualErrorsIsAThousandthAndOfNoneUnknown) {
  EXPECT_NEAR(top_share(std::vector<float>(4000, 0.25f)), 0.001, 1e-12);
  EXPECT_EQ(top_share({3.0f}), 1.0);
  EXPECT_TRUE(std::isnan(top_share(std::vector<float>(10, 0.0f))));
  EXPECT_TRUE(std::isnan(top_share({})));
  EXPECT_EQ(top_share_text(0.826), "83 %");
  EXPECT_EQ(top_share_text(std::nan("")), "–");
}

// 2000 pixels: white off by 0.1 everywhere, by 10 in each of two, and one that is no number.
TEST(TopShare, OfRelmseLooksAtThePixels) {
  RadianceImage reference(50, 40, glm::vec3(1.0f));
  RadianceImage test(50, 40, glm::vec3(1.1f));
  test.at(3, 4) = glm::vec3(11.0f);
  test.at(30, 20) = glm::vec3(1.0f, 11.0f, 1.0f);
  const double small = 1997.0 * 0.01;
  EXPECT_NEAR(relmse_top_share(test, reference),
              (100.0 + 100.0 / 3.0) / (100.0 + 100.0 / 3.0 + small + 0.01), 1e-6);
  test.at(7, 7) = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  EXPECT_NEAR(relmse_top_share(test, reference),
              (100.0 + 100.0 / 3.0) / (100.0 + 100.0 / 3.0 + small), 1e-6);
  EXPECT_THROW(relmse_top_share(test, RadianceImage(2, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace quartet
