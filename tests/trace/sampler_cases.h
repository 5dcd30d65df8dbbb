#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/trace/sampler.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/statistics.h"

namespace quartet::test {

struct Point {
  float u, v;
};

/// The numbers of one vertex, copied out.
inline std::array<float, Sampler::draws_per_call> draws_of(std::uint64_t seed, std::uint32_t pixel,
                                                           std::uint32_t index, int vertex,
                                                           SamplerId id = SamplerId::sobol) {
  Sampler sampler(seed, pixel, index, id);
  for (int i = 0; i < vertex; ++i) {
    sampler.next();
  }
  const Sampler::Draws& draws = sampler.next();
  std::array<float, Sampler::draws_per_call> copy{};
  std::copy(std::begin(draws), std::end(draws), copy.begin());
  return copy;
}

inline float draw(std::uint64_t seed, std::uint32_t pixel, std::uint32_t index, int dimension,
                  SamplerId id = SamplerId::sobol) {
  return draws_of(seed, pixel, index, dimension / Sampler::draws_per_call,
                  id)[std::size_t(dimension % Sampler::draws_per_call)];
}

/// Whether 2^k points are a (0, k, 2)-net: every box of 2^-a by 2^-(k-a) holds exactly one.
inline bool is_net(std::span<const Point> points, int k) {
  std::vector<char> hit(points.size());
  for (int a = 0; a <= k; ++a) {
    std::fill(hit.begin(), hit.end(), char(0));
    for (const Point& p : points) {
      const auto x = std::size_t(std::ldexp(p.u, a));
      const auto y = std::size_t(std::ldexp(p.v, k - a));
      char& cell = hit[(x << (k - a)) + y];
      if (cell) {
        return false;
      }
      cell = 1;
    }
  }
  return true;
}

/// Independence: pairs of streams, each at p of Pearson's correlation and of a
/// chi-square over 16 × 16 cells. False-alarm rate of each test below: 1e-3 over all its pairs.
class PairTests {
 public:
  static constexpr int cells = 16;
  static constexpr std::uint32_t count = 1u << 13;
  static constexpr double family = 1e-3;

  /// `x` and `y` map a number below `count` to [0, 1).
  template <class X, class Y>
  void add(const std::string& name, const X& x, const Y& y) {
    std::vector<double> observed(cells * cells, 0.0);
    Correlation correlation;
    for (std::uint32_t i = 0; i < count; ++i) {
      const float a = x(i);
      const float b = y(i);
      correlation.add(double(a), double(b));
      observed[std::size_t(a * cells) * cells + std::size_t(b * cells)] += 1.0;
    }
    const std::vector<double> expected(cells * cells, double(count) / (cells * cells));
    results_.push_back({name + " correlation", two_sided_p(correlation.score())});
    results_.push_back({name + " cells", chi_square_test(observed, expected).p});
  }

  ~PairTests() {
    const double level = sidak_level(family, double(results_.size()));
    for (const auto& [name, p] : results_) {
      EXPECT_GE(p, level) << name << " (one of " << results_.size() << " tests)";
    }
  }

 private:
  std::vector<std::pair<std::string, double>> results_;
};

}  // namespace quartet::test
