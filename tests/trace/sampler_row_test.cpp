#include "renderer/trace/sampler_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/trace/sampler_cases.h"

namespace quartet {
namespace {

using test::Correlation;
using test::draw;
using test::draws_of;
using test::PairTests;
using test::sidak_level;
using test::two_sided_p;

TEST(Samplers, AreFoundById) {
  std::set<std::string_view> ids;
  for (const SamplerRow& row : samplers()) {
    EXPECT_TRUE(ids.insert(row.id).second);
    EXPECT_EQ(&find_sampler(row.id), &row);
    EXPECT_EQ(&sampler_row(row.key), &row);
    EXPECT_FALSE(row.description.empty());
    EXPECT_FALSE(row.variance.empty());
    EXPECT_EQ(row.knows_variance, row.variance_channel == "Variance") << row.id;
  }
  EXPECT_THROW(find_sampler("halton"), std::invalid_argument);
}

// Every picture that was made before there was a choice is to come out again, to the bit.
TEST(Samplers, SobolIsWhatItWas) {
  const auto first = draws_of(12, 345, 6, 0);
  const auto later = draws_of(12, 345, 6, 5);
  EXPECT_EQ(first,
            (std::array<float, 4>{0x1.6ef35ap-1f, 0x1.b73d36p-1f, 0x1.5ffb78p-3f, 0x1.2a0414p-1f}));
  EXPECT_EQ(later,
            (std::array<float, 4>{0x1.871134p-1f, 0x1.e3e6p-5f, 0x1.f7b414p-1f, 0x1.fc6e2cp-2f}));
  Sampler sampler(12, 345, 6);
  sampler.next();
  EXPECT_EQ(sampler.independent(), 0x1.af0fdap-1f);
}

TEST(Samplers, DrawOtherNumbersEach) {
  std::vector<float> numbers;
  for (const SamplerRow& row : samplers()) {
    for (const std::uint32_t index : {0u, 1u, 4u, 5u}) {
      const auto d = draws_of(3, 77, index, 0, row.key);
      numbers.insert(numbers.end(), d.begin(), d.end());
    }
  }
  std::ranges::sort(numbers);
  EXPECT_EQ(std::ranges::adjacent_find(numbers), numbers.end());
}

constexpr SamplerId plain_numbers = SamplerId::independent;
constexpr SamplerId four_sequences = SamplerId::replicated;

// Within one pixel, where sobol is stratified. False-alarm rate of each test: PairTests::family.
TEST(IndependentSampler, IndicesOfAPixel) {
  PairTests tests;
  for (const std::uint32_t pixel : {0u, 7u, 959u}) {
    for (const std::uint32_t distance : {1u, 2u, 3u, 4u, 8u}) {
      for (int a = 0; a < 8; ++a) {
        for (const int b : {a, a ^ 1, (a + 2) % 8, a + 8}) {
          tests.add(
              "pixel " + std::to_string(pixel) + ", indices " + std::to_string(distance) +
                  " apart, dimensions " + std::to_string(a) + " and " + std::to_string(b),
              // Every index in one pair only, or the pairs would not be independent.
              [&](std::uint32_t i) { return draw(21, pixel, 16 * i, a, plain_numbers); },
              [&](std::uint32_t i) {
                return draw(21, pixel, 16 * i + distance, b, plain_numbers);
              });
        }
      }
    }
  }
}

TEST(IndependentSampler, DimensionsOfASample) {
  PairTests tests;
  for (int a = 0; a < 12; ++a) {
    for (int b = a + 1; b < 12; ++b) {
      tests.add(
          "over indices, dimensions " + std::to_string(a) + " and " + std::to_string(b),
          [&](std::uint32_t i) { return draw(22, 5, i, a, plain_numbers); },
          [&](std::uint32_t i) { return draw(22, 5, i, b, plain_numbers); });
      tests.add(
          "over pixels, dimensions " + std::to_string(a) + " and " + std::to_string(b),
          [&](std::uint32_t p) { return draw(22, p, 9, a, plain_numbers); },
          [&](std::uint32_t p) { return draw(22, p, 9, b, plain_numbers); });
    }
  }
}

TEST(IndependentSampler, PixelsAndSeeds) {
  PairTests tests;
  for (int a = 0; a < 8; ++a) {
    for (const int b : {a, a ^ 1, (a + 2) % 8, a + 8}) {
      const std::string dims = ", dimensions " + std::to_string(a) + " and " + std::to_string(b);
      tests.add(
          "the next pixel's, over indices" + dims,
          [&](std::uint32_t i) { return draw(23, 5, i, a, plain_numbers); },
          [&](std::uint32_t i) { return draw(23, 6, i, b, plain_numbers); });
      tests.add(
          "the next seed's, over indices" + dims,
          [&](std::uint32_t i) { return draw(23, 5, i, a, plain_numbers); },
          [&](std::uint32_t i) { return draw(24, 5, i, b, plain_numbers); });
      tests.add(
          "the next pixel's next index" + dims,
          [&](std::uint32_t p) { return draw(23, 2 * p, 3, a, plain_numbers); },
          [&](std::uint32_t p) { return draw(23, 2 * p + 1, 4, b, plain_numbers); });
    }
  }
}

TEST(IndependentSampler, TheNumberOfItsOwn) {
  const auto own = [](std::uint32_t index, int vertex) {
    Sampler sampler(25, 5, index, plain_numbers);
    for (int i = 0; i <= vertex; ++i) {
      sampler.next();
    }
    return sampler.independent();
  };
  PairTests tests;
  for (int vertex = 0; vertex < 4; ++vertex) {
    const std::string name = "vertex " + std::to_string(vertex);
    for (int b = 0; b < 16; ++b) {
      tests.add(
          name + " and dimension " + std::to_string(b),
          [&](std::uint32_t i) { return own(i, vertex); },
          [&](std::uint32_t i) { return draw(25, 5, i, b, plain_numbers); });
    }
    tests.add(
        name + " and the next index", [&](std::uint32_t i) { return own(2 * i, vertex); },
        [&](std::uint32_t i) { return own(2 * i + 1, vertex); });
    tests.add(
        name + " and the next vertex", [&](std::uint32_t i) { return own(i, vertex); },
        [&](std::uint32_t i) { return own(i, vertex + 1); });
  }
}

/// Mean square of the error of the first n samples in the mean of u v, in multiples of that of
/// independent ones.
double relative_variance(SamplerId id, std::uint32_t n, std::uint32_t pixels) {
  double squares = 0.0;
  for (std::uint32_t p = 0; p < pixels; ++p) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto d = draws_of(31, p, i, 1, id);
      sum += double(d[2]) * double(d[3]) - 0.25;
    }
    squares += (sum / n) * (sum / n);
  }
  constexpr double of_one = 1.0 / 9.0 - 1.0 / 16.0;
  return squares / pixels / (of_one / n);
}

TEST(Samplers, DifferInTheirNoise) {
  // The mean of 8192 squares of nearly normal numbers is known to 1.6 %: five of that, a false
  // alarm in 2e6.
  for (const std::uint32_t n : {4u, 16u, 64u}) {
    EXPECT_NEAR(relative_variance(plain_numbers, n, 8192), 1.0, 0.08) << n;
  }
  // Four sequences of 16 are as far from one of 64 as scrambled nets of 16 and 64 points are.
  const double sobol = relative_variance(SamplerId::sobol, 64, 2048);
  const double of_16 = relative_variance(SamplerId::sobol, 16, 2048);
  const double four = relative_variance(four_sequences, 64, 2048);
  EXPECT_LT(sobol, 0.6 * four);
  EXPECT_NEAR(four / of_16, 1.0, 0.2);
}

TEST(ReplicatedSampler, EachSequenceIsOfNets) {
  for (std::uint32_t pixel = 0; pixel < 40; ++pixel) {
    for (std::uint32_t r = 0; r < sampler_replicates; ++r) {
      for (const int vertex : {0, 3}) {
        for (const std::size_t pair : {0u, 1u}) {
          constexpr int k = 6;
          std::vector<test::Point> points;
          for (std::uint32_t i = 0; i < 1u << k; ++i) {
            const auto d = draws_of(41, pixel, i * sampler_replicates + r, vertex, four_sequences);
            points.push_back({d[2 * pair], d[2 * pair + 1]});
          }
          EXPECT_TRUE(test::is_net(points, k)) << pixel << " " << r << " " << vertex << " " << pair;
        }
      }
    }
  }
}

// What their variance is had from: the errors that two sequences of a pixel make know nothing of
// each other. False-alarm rate of the test: 1e-3.
TEST(ReplicatedSampler, SequencesAreIndependent) {
  const auto error = [](std::uint32_t pixel, std::uint32_t r, std::size_t pair) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < 8; ++i) {
      const auto d = draws_of(42, pixel, i * sampler_replicates + r, 1, four_sequences);
      sum += double(d[2 * pair]) * double(d[2 * pair + 1]);
    }
    return sum / 8.0 - 0.25;
  };
  constexpr double cases = 2.0 * sampler_replicates * (sampler_replicates - 1) / 2.0;
  for (const std::size_t pair : {0u, 1u}) {
    for (std::uint32_t r = 0; r < sampler_replicates; ++r) {
      for (std::uint32_t other = 0; other < r; ++other) {
        Correlation correlation;
        for (std::uint32_t p = 0; p < 4096; ++p) {
          correlation.add(error(p, r, pair), error(p, other, pair));
        }
        EXPECT_GE(two_sided_p(correlation.score()), sidak_level(1e-3, cases))
            << "sequences " << r << " and " << other << ", correlation "
            << correlation.coefficient();
      }
    }
  }
}

}  // namespace
}  // namespace quartet
