#include "renderer/adaptive/estimators/quantiles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quartet {
namespace {

// Abramowitz and Stegun, tables 26.10 and 26.8, and NIST's handbook: three decimals and more.
TEST(Quantiles, StudentAsTabulated) {
  constexpr struct {
    std::uint32_t freedom;
    double t;
  } rows[] = {{1, 12.706},  {2, 4.303},   {3, 3.182},   {4, 2.776},   {5, 2.571},   {7, 2.365},
              {10, 2.228},  {15, 2.131},  {20, 2.086},  {30, 2.042},  {40, 2.021},  {60, 2.000},
              {100, 1.984}, {120, 1.980}, {200, 1.972}, {500, 1.965}, {1000, 1.962}};
  for (const auto& row : rows) {
    EXPECT_NEAR(student_t_975(row.freedom), row.t, 5.001e-4) << row.freedom;
  }
  EXPECT_NEAR(student_t_975(1u << 31), 1.959963984540054, 2e-9);
}

TEST(Quantiles, StudentInClosedForm) {
  // One degree of freedom is Cauchy's distribution, two have a closed form as well.
  EXPECT_NEAR(student_t_975(1), std::tan(M_PI * 0.475), 1e-11);
  EXPECT_NEAR(student_t_975(2), 0.95 * std::sqrt(2.0 / (1.0 - 0.95 * 0.95)), 1e-12);
}

TEST(Quantiles, ChiSquareAsTabulated) {
  constexpr struct {
    std::uint32_t freedom;
    double x;
  } rows[] = {{3, 0.352},   {4, 0.711},    {5, 1.145},     {7, 2.167},     {10, 3.940},
              {15, 7.261},  {20, 10.851},  {30, 18.493},   {40, 26.509},   {60, 43.188},
              {80, 60.391}, {100, 77.929}, {200, 168.279}, {500, 449.147}, {1000, 927.594}};
  for (const auto& row : rows) {
    EXPECT_NEAR(chi_square_05(row.freedom), row.x, 5.001e-4) << row.freedom;
  }
}

TEST(Quantiles, ChiSquareInClosedForm) {
  // Of one degree of freedom: the square of a normal variable; of two: exponential.
  const double normal = std::sqrt(chi_square_05(1));
  EXPECT_NEAR(std::erf(normal / std::sqrt(2.0)), 0.05, 1e-12);
  EXPECT_NEAR(chi_square_05(2), -2.0 * std::log(0.95), 1e-13);
}

TEST(Quantiles, TablesMeetTheirExpansions) {
  // Where the table ends, the next value must follow as smoothly as those within: the second
  // differences of a wrong expansion would jump.
  const auto second_difference = [](double (*quantile)(std::uint32_t), std::uint32_t at) {
    return quantile(at + 1) - 2.0 * quantile(at) + quantile(at - 1);
  };
  for (const std::uint32_t at : {126u, 127u, 128u, 129u}) {
    EXPECT_NEAR(second_difference(student_t_975, at), second_difference(student_t_975, 120), 1e-6);
    EXPECT_NEAR(second_difference(chi_square_05, at), second_difference(chi_square_05, 120), 2e-4);
  }
  for (std::uint32_t freedom = 1; freedom < 2000; ++freedom) {
    EXPECT_GT(student_t_975(freedom), student_t_975(freedom + 1)) << freedom;
    EXPECT_LT(chi_square_05(freedom), chi_square_05(freedom + 1)) << freedom;
  }
}

}  // namespace
}  // namespace quartet
