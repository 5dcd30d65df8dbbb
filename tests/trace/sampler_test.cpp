#include "renderer/trace/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/trace/sampler_cases.h"

namespace quartet {
namespace {

using test::Correlation;
using test::draw;
using test::draws_of;
using test::is_net;
using test::PairTests;
using test::Point;
using test::sidak_level;
using test::two_sided_p;

TEST(Sampler, DrawsLieInTheUnitInterval) {
  float smallest = 1.0f;
  float largest = 0.0f;
  for (std::uint32_t pixel = 0; pixel < 20000; ++pixel) {
    Sampler sampler(pixel % 7, pixel, pixel * 3);
    for (int vertex = 0; vertex < 6; ++vertex) {
      for (const float x : sampler.next()) {
        smallest = std::min(smallest, x);
        largest = std::max(largest, x);
      }
    }
  }
  EXPECT_GE(smallest, 0.0f);
  EXPECT_LT(largest, 1.0f);
  // Of 960 000 numbers, none below 1e-4 has probability 1e-42.
  EXPECT_LT(smallest, 1e-4f);
  EXPECT_GT(largest, 1.0f - 1e-4f);
}

TEST(Sampler, IsAPureFunctionOfItsArguments) {
  Sampler a(12, 345, 6);
  Sampler b(12, 345, 6);
  std::vector<float> first;
  for (int vertex = 0; vertex < 9; ++vertex) {
    for (const float x : a.next()) {
      first.push_back(x);
    }
  }
  Sampler(99, 345, 6).next();
  std::size_t i = 0;
  for (int vertex = 0; vertex < 9; ++vertex) {
    for (const float x : b.next()) {
      EXPECT_EQ(x, first[i++]);
    }
  }
  // No number comes twice among those of one sample, or of its neighbours in any argument.
  for (const auto& other : {draws_of(12, 345, 7, 0), draws_of(12, 346, 6, 0),
                            draws_of(13, 345, 6, 0), draws_of(12 + (1ull << 32), 345, 6, 0)}) {
    first.insert(first.end(), other.begin(), other.end());
  }
  std::sort(first.begin(), first.end());
  EXPECT_EQ(std::adjacent_find(first.begin(), first.end()), first.end());
}

TEST(Sampler, EveryAlignedPowerOfTwoIsANetInEveryPair) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 150; ++trial) {
    const std::uint64_t seed = trial < 50 ? std::uint64_t(trial) : random() * 0x100000001ull;
    const std::uint32_t pixel = trial < 100 ? std::uint32_t(trial) : std::uint32_t(random());
    for (int k = 0; k <= 8; ++k) {
      const std::uint32_t count = 1u << k;
      // The first block, which is every first 8 for k = 3, and one far out.
      for (const std::uint32_t block : {0u, std::uint32_t(random()) >> k}) {
        for (const int vertex : {0, trial % 5}) {
          std::array<std::vector<Point>, Sampler::draws_per_call / 2> pairs;
          for (std::uint32_t i = 0; i < count; ++i) {
            const auto d = draws_of(seed, pixel, block * count + i, vertex);
            for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
              pairs[pair].push_back({d[2 * pair], d[2 * pair + 1]});
            }
          }
          for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
            ASSERT_TRUE(is_net(pairs[pair], k))
                << "pixel " << pixel << " seed " << seed << " vertex " << vertex << " pair " << pair
                << " samples from " << block * count << ", 2^" << k;
          }
        }
      }
    }
  }
}

TEST(Sampler, APlainGridOfSamplesIsNoNet) {
  // is_net() itself must be able to fail.
  const std::array<Point, 4> grid{{{0.1f, 0.1f}, {0.2f, 0.6f}, {0.6f, 0.2f}, {0.7f, 0.7f}}};
  EXPECT_FALSE(is_net(grid, 2));
}

constexpr int dimensions = 6 * Sampler::draws_per_call;

TEST(SamplerIndependence, NoPictureOfNoiseIsAnotherOnesShifted) {
  // With keys of 32 bits, some pixel of some seed must share its numbers with pixel 0 of another
  // seed; but then the next pixels must not.
  const auto numbers = [](std::uint64_t seed, std::uint32_t pixel) {
    const auto d = draws_of(seed, pixel, 0, 0);
    return std::array<float, 4>{d[0], d[1], d[2], d[3]};
  };
  constexpr std::uint64_t seeds = 1u << 14;
  std::map<std::array<float, 4>, std::uint64_t> at_pixel_0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    at_pixel_0.emplace(numbers(seed, 0), seed);
  }
  int shared = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    for (std::uint32_t pixel = 1; pixel <= 64; ++pixel) {
      const auto found = at_pixel_0.find(numbers(seed, pixel));
      if (found != at_pixel_0.end()) {
        ++shared;
        EXPECT_NE(numbers(seed, pixel + 1), numbers(found->second, 1))
            << "seeds " << seed << " and " << found->second << ", " << pixel << " pixels apart";
      }
    }
  }
  EXPECT_GT(shared, 0) << "expected 4 on average; without one this test shows nothing";
}

TEST(SamplerIndependence, DimensionsOfASample) {
  PairTests tests;
  for (const std::uint32_t index : {0u, 5u}) {
    for (int a = 0; a < dimensions; ++a) {
      for (int b = a + 1; b < dimensions; ++b) {
        tests.add(
            "dimensions " + std::to_string(a) + " and " + std::to_string(b),
            [&](std::uint32_t p) { return draw(3, p, index, a); },
            [&](std::uint32_t p) { return draw(3, p, index, b); });
      }
    }
  }
}

TEST(SamplerIndependence, TheNumberOfItsOwn) {
  const auto own = [](std::uint64_t seed, std::uint32_t pixel, std::uint32_t index, int vertex) {
    Sampler sampler(seed, pixel, index);
    for (int i = 0; i <= vertex; ++i) {
      sampler.next();
    }
    return sampler.independent();
  };
  PairTests tests;
  for (int vertex = 0; vertex < 6; ++vertex) {
    const std::string name = "vertex " + std::to_string(vertex);
    const auto it = [&](std::uint32_t p) { return own(11, p, 3, vertex); };
    for (int b = 0; b < dimensions; ++b) {
      tests.add(name + " and dimension " + std::to_string(b), it,
                [&](std::uint32_t p) { return draw(11, p, 3, b); });
    }
    for (int other = 0; other < vertex; ++other) {
      tests.add(name + " and " + std::to_string(other), it,
                [&](std::uint32_t p) { return own(11, p, 3, other); });
    }
    tests.add(
        name + ", pixels 1 apart", [&](std::uint32_t p) { return own(11, 2 * p, 3, vertex); },
        [&](std::uint32_t p) { return own(11, 2 * p + 1, 3, vertex); });
    tests.add(
        name + ", indices 1 apart", [&](std::uint32_t i) { return own(11, 5, 2 * i, vertex); },
        [&](std::uint32_t i) { return own(11, 5, 2 * i + 1, vertex); });
    tests.add(name + ", next index", it, [&](std::uint32_t p) { return own(11, p, 4, vertex); });
    tests.add(name + ", next seed", it, [&](std::uint32_t p) { return own(12, p, 3, vertex); });
  }
}

TEST(SamplerIndependence, DimensionsOfNeighbouringSamples) {
  PairTests tests;
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < dimensions; ++b) {
      if (a / 2 == b / 2) {
        continue;  // stratified together, by design
      }
      tests.add(
          "dimension " + std::to_string(a) + " and the next sample's " + std::to_string(b),
          [&](std::uint32_t p) { return draw(4, p, 6, a); },
          [&](std::uint32_t p) { return draw(4, p, 7, b); });
    }
  }
}

TEST(SamplerIndependence, Pixels) {
  PairTests tests;
  for (const std::uint32_t distance : {1u, 2u, 3u, 64u, 959u, 960u, 961u, 1u << 20}) {
    for (int a = 0; a < 8; ++a) {
      for (const int b : {a, a ^ 1, (a + 2) % 8, a + 8}) {
        tests.add(
            "pixels " + std::to_string(distance) + " apart, dimensions " + std::to_string(a) +
                " and " + std::to_string(b),
            // Every pixel in one pair only, or its pairs would not be independent.
            [&](std::uint32_t p) { return draw(5, p * 1999u, 2, a); },
            [&](std::uint32_t p) { return draw(5, p * 1999u + distance, 2, b); });
      }
    }
  }
}

TEST(SamplerIndependence, Seeds) {
  PairTests tests;
  for (const std::uint64_t change : {1ull, 2ull, 3ull, 1ull << 16, 1ull << 31, 1ull << 32,
                                     1ull << 48, 1ull << 63, 0x100000001ull}) {
    for (int a = 0; a < 8; ++a) {
      for (const int b : {a, a ^ 1, (a + 2) % 8, a + 8}) {
        const std::string dims = ", dimensions " + std::to_string(a) + " and " + std::to_string(b);
        tests.add(
            "seeds s and s ^ " + std::to_string(change) + " over pixels" + dims,
            [&](std::uint32_t p) { return draw(6, p, 1, a); },
            [&](std::uint32_t p) { return draw(6 ^ change, p, 1, b); });
        tests.add(
            "seeds s and s ^ " + std::to_string(change) + " over seeds" + dims,
            [&](std::uint32_t s) { return draw(8 * s, 7, 1, a); },
            [&](std::uint32_t s) { return draw((8 * s) ^ change, 7, 1, b); });
      }
    }
  }
}

/// The error that the first 8 samples of a pixel make in the mean of u v over [0, 1)²: what is left
/// after stratification must be independent, or noise would show patterns.
double error_of_8(std::uint64_t seed, std::uint32_t pixel, int vertex, std::size_t pair) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const auto d = draws_of(seed, pixel, i, vertex);
    sum += double(d[2 * pair]) * double(d[2 * pair + 1]);
  }
  return sum / 8.0 - 0.25;
}

TEST(SamplerIndependence, ErrorsOfEightSamples) {
  struct Case {
    std::string name;
    std::function<double(std::uint32_t)> a, b;
  };
  std::vector<Case> cases;
  for (std::size_t pair = 0; pair < 2; ++pair) {
    const auto base = [=](std::uint32_t p) { return error_of_8(9, p * 1999u, 0, pair); };
    const std::string which = " of pair " + std::to_string(pair);
    for (const std::uint32_t distance : {1u, 2u, 960u}) {
      cases.push_back(
          {"pixels " + std::to_string(distance) + " apart" + which, base,
           [=](std::uint32_t p) { return error_of_8(9, p * 1999u + distance, 0, pair); }});
    }
    for (const std::uint64_t seed : {10ull, 9ull + (1ull << 32)}) {
      cases.push_back({"seeds 9 and " + std::to_string(seed) + which, base,
                       [=](std::uint32_t p) { return error_of_8(seed, p * 1999u, 0, pair); }});
    }
    for (int vertex = 0; vertex < 6; ++vertex) {
      for (std::size_t other = 0; other < 2; ++other) {
        if (vertex > 0 || other > pair) {
          cases.push_back(
              {"vertex " + std::to_string(vertex) + " pair " + std::to_string(other) + which, base,
               [=](std::uint32_t p) { return error_of_8(9, p * 1999u, vertex, other); }});
        }
      }
    }
  }
  const double level = sidak_level(1e-3, double(cases.size()));  // false-alarm rate 1e-3
  for (const Case& c : cases) {
    Correlation correlation;
    for (std::uint32_t p = 0; p < 4096; ++p) {
      correlation.add(c.a(p), c.b(p));
    }
    EXPECT_GE(two_sided_p(correlation.score()), level)
        << c.name << ", correlation " << correlation.coefficient();
  }
}

TEST(Sampler, IntegratesSmoothFunctionsFasterThanRandomNumbers) {
  const auto f = [](float u, float v) { return std::exp(double(u) + 2.0 * double(v)); };
  const double truth = (std::exp(1.0) - 1.0) * (std::exp(2.0) - 1.0) / 2.0;
  const double second = (std::exp(2.0) - 1.0) / 2.0 * (std::exp(4.0) - 1.0) / 4.0;
  const double sigma = std::sqrt(second - truth * truth);
  const auto rms_error = [&](std::uint32_t n) {
    double squares = 0.0;
    constexpr std::uint32_t pixels = 256;
    for (std::uint32_t p = 0; p < pixels; ++p) {
      double sum = 0.0;
      for (std::uint32_t i = 0; i < n; ++i) {
        const auto d = draws_of(2, p, i, 1);
        sum += f(d[2], d[3]);
      }
      squares += (sum / n - truth) * (sum / n - truth);
    }
    return std::sqrt(squares / pixels);
  };
  // Owen: the error falls with n^(-3/2), 64-fold from 16 to 256; random numbers reach 4-fold. The
  // mean of 256 squared errors is known to 9 %.
  const double at_16 = rms_error(16);
  const double at_256 = rms_error(256);
  EXPECT_LT(at_16, 0.35 * sigma / 4.0);
  EXPECT_LT(at_256, at_16 / 45.0);
}

}  // namespace
}  // namespace quartet
