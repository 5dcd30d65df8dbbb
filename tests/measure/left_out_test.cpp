#include "renderer/measure/left_out.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

RadianceImage random_picture(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(0.0f, 1.0f);
  RadianceImage image(width, height);
  for (glm::vec3& pixel : image.pixels()) {
    pixel = {number(random), number(random), number(random)};
  }
  return image;
}

TEST(LeftOut, CountsPixelsOnce) {
  RadianceImage test(3, 2);
  RadianceImage truth(3, 2);
  test.at(0, 0) = {missing, missing, 0.0f};
  test.at(2, 1).b = -std::numeric_limits<float>::infinity();
  truth.at(2, 1).r = missing;
  truth.at(1, 0).g = missing;
  const LeftOut left_out = left_out_of(test, truth);
  EXPECT_EQ(left_out.test, 2u);
  EXPECT_EQ(left_out.reference, 2u);
  EXPECT_EQ(left_out.either, 3u);
  EXPECT_EQ(left_out.is_left_out, (std::vector<char>{1, 1, 0, 0, 0, 1}));
}

TEST(LeftOut, NothingChangesWhereAllIsFinite) {
  const RadianceImage test = random_picture(40, 30, 1);
  const RadianceImage truth = random_picture(40, 30, 2);
  for (const Metric& row : metrics()) {
    EXPECT_EQ(compute_over_finite(row, test, truth), row.compute(test, truth)) << row.id;
    EXPECT_EQ(map_over_finite(row, test, truth), row.map(test, truth)) << row.id;
  }
}

TEST(LeftOut, MetricsAreThoseOfTheOtherPixels) {
  // A column is missing on the right of one and in the middle of the other: the rest, as pictures
  // of their own.
  RadianceImage test = random_picture(40, 30, 1);
  RadianceImage truth = random_picture(40, 30, 2);
  RadianceImage kept_test(38, 30);
  RadianceImage kept_truth(38, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0, to = 0; x < 39; ++x) {
      if (x != 17) {
        kept_test.at(to, y) = test.at(x, y);
        kept_truth.at(to++, y) = truth.at(x, y);
      }
    }
    test.at(39, y).g = missing;
    truth.at(17, y) = glm::vec3(std::numeric_limits<float>::infinity());
  }
  for (const Metric& row : metrics()) {
    const double value = compute_over_finite(row, test, truth);
    if (row.looks_around) {
      // Neighbours of what is missing look at black in both.
      EXPECT_NEAR(value, row.compute(kept_test, kept_truth), 0.05) << row.id;
    } else {
      EXPECT_EQ(value, row.compute(kept_test, kept_truth)) << row.id;
    }
    const ScalarImage map = map_over_finite(row, test, truth);
    double sum = 0.0;
    for (int y = 0; y < 30; ++y) {
      EXPECT_EQ(map.at(39, y), 0.0f);
      EXPECT_EQ(map.at(17, y), 0.0f);
    }
    for (const float error : map.pixels()) {
      sum += error;
    }
    if (row.looks_around) {
      EXPECT_NEAR(value, sum / (38.0 * 30.0), 1e-9) << row.id;
    }
  }
}

TEST(LeftOut, EqualPicturesStayEqualWhereTheyAreKnown) {
  RadianceImage test = random_picture(20, 20, 3);
  const RadianceImage truth = test;
  test.at(10, 10) = glm::vec3(missing);
  for (const Metric& row : metrics()) {
    const double value = compute_over_finite(row, test, truth);
    EXPECT_TRUE(row.higher_is_better ? std::isinf(value) : value == 0.0) << row.id;
  }
}

TEST(LeftOut, NothingToCompareIsAnError) {
  const RadianceImage nothing(2, 2, glm::vec3(missing));
  for (const Metric& row : metrics()) {
    EXPECT_NE(error_of([&] {
                compute_over_finite(row, nothing, RadianceImage(2, 2));
              }).find("no pixel is finite in both"),
              std::string::npos);
    EXPECT_NE(error_of([&] { map_over_finite(row, RadianceImage(3, 2), nothing); }).find("3x2"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace quartet
