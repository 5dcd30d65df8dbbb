#include "renderer/scene/synthetic.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "renderer/adaptive/lab.h"
#include "renderer/scene/load_scene.h"
#include "renderer/trace/store/running_mean.h"
#include "tests/trace/statistics.h"

namespace quartet::test {
namespace {

constexpr int side = 256;
constexpr int each = 32;

/// Accepted samples of a square of pixels, and how many were not.
struct Drawn {
  Moments moments;
  double squares = 0.0;  ///< sum of squared deviations from the exact mean
  double fourths = 0.0;
  long rejected = 0;
};

Drawn draw(const Synthetic& row) {
  Drawn drawn;
  std::array<glm::vec3, each> samples;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      draw_synthetic(row, 7, x, y, 0, samples);
      for (const glm::vec3& sample : samples) {
        if (!acceptable(sample)) {
          ++drawn.rejected;
          continue;
        }
        EXPECT_EQ(sample.x, sample.y);
        EXPECT_EQ(sample.x, sample.z);
        drawn.moments.add(double(sample.x));
        const double square = std::pow(double(sample.x) - row.mean, 2.0);
        drawn.squares += square;
        drawn.fourths += square * square;
      }
    }
  }
  return drawn;
}

// Of the mean: 2 million draws a row; false alarms 1e-6 in each of 6 rows. Of the variance: where
// the fourth moment is finite, the same; the heavy tail and the log-normal are judged by quantiles
// below.
TEST(Synthetic, MeanAndVarianceAreWhatTheTableSays) {
  for (const Synthetic& row : synthetics()) {
    const Drawn drawn = draw(row);
    const double n = double(drawn.moments.count());
    if (row.variance == 0.0) {
      EXPECT_EQ(drawn.moments.variance(), 0.0) << row.id;
      EXPECT_EQ(drawn.moments.mean(), row.mean) << row.id;
      continue;
    }
    EXPECT_GT(two_sided_p((drawn.moments.mean() - row.mean) / std::sqrt(row.variance / n)), 1e-6)
        << row.id << " " << drawn.moments.mean();
    if (row.id != "pareto" && row.id != "log-normal") {
      const double variance = drawn.squares / n;
      const double of_variance = (drawn.fourths / n - variance * variance) / n;
      EXPECT_GT(two_sided_p((variance - row.variance) / std::sqrt(of_variance)), 1e-6)
          << row.id << " " << variance;
    }
  }
}

/// Share of the samples of a row above a value.
double share_above(std::string_view id, double value) {
  long above = 0;
  std::array<glm::vec3, each> samples;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      draw_synthetic(find_synthetic(id), 11, x, y, 0, samples);
      for (const glm::vec3& sample : samples) {
        above += double(sample.x) > value ? 1 : 0;
      }
    }
  }
  return double(above) / (double(side) * side * each);
}

// A share p of n draws has the standard deviation √(p(1 − p)/n); 5 of them: false alarms under
// 1e-6.
TEST(Synthetic, TailsFallAsTheyShould) {
  const auto expect_share = [](std::string_view id, double value, double expected) {
    const double deviation = std::sqrt(expected * (1.0 - expected) / (double(side) * side * each));
    EXPECT_NEAR(share_above(id, value), expected, 5.0 * deviation) << id << " above " << value;
  };
  for (const double value : {0.7, 2.0, 10.0}) {
    expect_share("pareto", value, std::pow(0.6 / value, 2.5));
    expect_share("log-normal", value, 0.5 * std::erfc((std::log(value) + 0.5) / std::sqrt(2.0)));
  }
}

TEST(Synthetic, OnlyTheBadSourcesAreRejected) {
  for (const Synthetic& row : synthetics()) {
    const Drawn drawn = draw(row);
    const double share = double(drawn.rejected) / (double(side) * side * each);
    const double expected = row.id == "non-finite" ? 0.02 : row.id == "negative" ? 0.01 : 0.0;
    EXPECT_NEAR(share, expected, 5.0 * std::sqrt(expected / (double(side) * side * each)))
        << row.id;
  }
}

TEST(Synthetic, IsAPureFunctionOfPixelIndexAndSeed) {
  const Synthetic& row = find_synthetic("log-normal");
  std::array<glm::vec3, 8> together;
  draw_synthetic(row, 3, 5, 9, 0, together);
  for (std::uint32_t i = 0; i < together.size(); ++i) {
    glm::vec3 alone(0.0f);
    draw_synthetic(row, 3, 5, 9, i, std::span(&alone, 1));
    EXPECT_EQ(alone, together[i]) << i;
  }
  for (const auto& [seed, x, y] : {std::array{4, 5, 9}, {3, 9, 5}, {3, 6, 9}, {3, 5, 10}}) {
    std::array<glm::vec3, 8> other;
    draw_synthetic(row, std::uint64_t(seed), x, y, 0, other);
    EXPECT_NE(other, together);
  }
}

// Neighbours, next indices and next seeds: 65 536 pairs each, |correlation| normal with standard
// deviation 1/256; false alarms 1e-6 each.
TEST(Synthetic, DrawsAreNotCorrelated) {
  const Synthetic& row = find_synthetic("non-finite");
  const auto uniform = [&](std::uint64_t seed, int x, int y, std::uint32_t index) {
    glm::vec3 sample(0.0f);
    draw_synthetic(row, seed, x, y, index, std::span(&sample, 1));
    return double(sample.x);
  };
  Correlation right;
  Correlation down;
  Correlation next;
  Correlation seed;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double here = uniform(1, x, y, 0);
      const auto add = [&](Correlation& correlation, double there) {
        if (std::isfinite(here) && std::isfinite(there)) {
          correlation.add(here, there);
        }
      };
      add(right, uniform(1, x + 1, y, 0));
      add(down, uniform(1, x, y + 1, 0));
      add(next, uniform(1, x, y, 1));
      add(seed, uniform(2, x, y, 0));
    }
  }
  for (const Correlation* correlation : {&right, &down, &next, &seed}) {
    EXPECT_GT(two_sided_p(correlation->score()), 1e-6);
  }
}

TEST(Synthetic, IsOpenedByNameAndFeedsALab) {
  const Scene scene = open_scene("synthetic:bernoulli");
  EXPECT_EQ(scene.name, "synthetic:bernoulli");
  EXPECT_EQ(lasting_scene_name("synthetic:bernoulli"), scene.name);
  EXPECT_THROW(open_scene("synthetic:bernoulli", {{"p", "0.5"}}), SceneError);
  try {
    open_scene("synthetic:coin");
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("'coin'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("bernoulli"), std::string::npos);
  }

  RenderSettings settings = default_settings(scene);
  settings.seed = 5;
  const LaneSettings lane = default_settings(EstimatorId::uniform);
  Lab lab(sample_source(std::make_shared<const TraceScene>(open_scene("synthetic:non-finite")),
                        settings),
          settings.width, settings.height, std::span(&lane, 1));
  for (int pass = 0; pass < 8; ++pass) {
    ASSERT_TRUE(lab.run_pass());
  }
  const Film& film = lab.lanes().front().film();
  // 2 in 100 of 49 152 samples, five standard deviations.
  EXPECT_NEAR(double(film.total_rejected()), 983.0, 155.0);
  for (int channel = 0; channel < 3; ++channel) {
    for (const float mean : film.mean(channel)) {
      EXPECT_TRUE(mean >= 0.0f && mean < 1.0f);
    }
  }
}

}  // namespace
}  // namespace quartet::test
