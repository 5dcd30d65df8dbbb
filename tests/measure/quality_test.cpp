#include "renderer/measure/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "renderer/adaptive/lab.h"

namespace quartet {
namespace {

std::vector<float> random_values(std::size_t count, unsigned seed, int steps) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> step(0, steps);
  std::vector<float> values(count);
  std::ranges::generate(values, [&] { return 0.25f * float(step(random)); });
  return values;
}

/// Spearman's from the definition: each rank is the number of smaller values and half the ties.
double brute_force_correlation(const std::vector<float>& a, const std::vector<float>& b) {
  const auto ranks = [](const std::vector<float>& values) {
    std::vector<double> each;
    for (const float v : values) {
      double rank = -0.5;
      for (const float w : values) {
        rank += w < v ? 1.0 : w == v ? 0.5 : 0.0;
      }
      each.push_back(rank);
    }
    return each;
  };
  const auto x = ranks(a);
  const auto y = ranks(b);
  const auto n = double(x.size());
  double sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    syy += y[i] * y[i];
    sxy += x[i] * y[i];
  }
  return (n * sxy - sx * sy) / std::sqrt((n * sxx - sx * sx) * (n * syy - sy * sy));
}

TEST(RankCorrelation, IsOneForAnyRisingAndMinusOneForAnyFallingFunction) {
  const std::vector<float> a{3, 1, 4, 1.5f, 9, 2.6f};
  std::vector<float> rising, falling;
  for (const float v : a) {
    rising.push_back(std::exp(v));
    falling.push_back(1 / v);
  }
  EXPECT_DOUBLE_EQ(rank_correlation(a, rising), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation(a, falling), -1.0);
}

TEST(RankCorrelation, WithoutTiesItIsTheClosedForm) {
  // 1 − 6 Σ d² / (n (n² − 1)); ranks 1 2 3 4 5 against 1 3 2 5 4: d² sums to 4.
  EXPECT_DOUBLE_EQ(
      rank_correlation(std::vector<float>{1, 2, 3, 4, 5}, std::vector<float>{1, 3, 2, 6, 3.5f}),
      1.0 - 6.0 * 4.0 / (5.0 * 24.0));
  // n = 3, ranks 1 2 3 against 2 1 3: d² sums to 2.
  EXPECT_DOUBLE_EQ(rank_correlation(std::vector<float>{1, 2, 3}, std::vector<float>{20, 10, 30}),
                   1.0 - 6.0 * 2.0 / (3.0 * 8.0));
}

TEST(RankCorrelation, TiesShareTheirRanks) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto a = random_values(97, seed, 6);
    const auto b = random_values(97, 1000 + seed, 3);
    EXPECT_NEAR(rank_correlation(a, b), brute_force_correlation(a, b), 1e-12);
  }
}

TEST(RankCorrelation, OfWhatDoesNotVaryIsNoNumber) {
  EXPECT_TRUE(std::isnan(rank_correlation(std::vector<float>{1, 1}, std::vector<float>{1, 2})));
  EXPECT_TRUE(std::isnan(rank_correlation(std::vector<float>{}, std::vector<float>{})));
}

TEST(CalibrationCurve, BinsHoldAllPixelsOnceInRisingOrder) {
  for (const int steps : {3, 50, 100000}) {
    const auto estimated = random_values(5000, 7, steps);
    const auto truth = random_values(5000, 8, 1000);
    const auto curve = calibration_curve(estimated, truth, 10);
    EXPECT_LE(curve.size(), 10u);
    EXPECT_GE(curve.size(), std::min<std::size_t>(10, std::size_t(steps) + 1) / 2);
    std::size_t pixels = 0;
    double estimated_sum = 0, truth_sum = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      pixels += curve[i].pixels;
      estimated_sum += curve[i].estimated * double(curve[i].pixels);
      truth_sum += curve[i].true_squared_error * double(curve[i].pixels);
      if (i > 0) {
        EXPECT_GT(curve[i].estimated, curve[i - 1].estimated);
      }
    }
    EXPECT_EQ(pixels, 5000u);
    EXPECT_NEAR(estimated_sum, std::accumulate(estimated.begin(), estimated.end(), 0.0), 1e-3);
    EXPECT_NEAR(truth_sum, std::accumulate(truth.begin(), truth.end(), 0.0), 1e-3);
  }
}

TEST(CalibrationCurve, OfAPerfectEstimatorIsTheDiagonal) {
  const auto truth = random_values(1000, 3, 100000);
  for (const CalibrationBin& bin : calibration_curve(truth, truth, 20)) {
    EXPECT_EQ(bin.pixels, 50u);
    EXPECT_DOUBLE_EQ(bin.estimated, bin.true_squared_error);
  }
}

TEST(CalibrationCurve, LeavesOutWhatIsNotFinite) {
  const float inf = std::numeric_limits<float>::infinity();
  const auto curve =
      calibration_curve(std::vector<float>{1, inf, 2}, std::vector<float>{5, 100, 7}, 2);
  ASSERT_EQ(curve.size(), 2u);
  EXPECT_EQ(curve[0].true_squared_error, 5.0);
  EXPECT_EQ(curve[1].true_squared_error, 7.0);
}

TEST(FalseStops, AreDonePixelsWorseThanHalfOfTheOthers) {
  using enum PixelState;
  using States = std::vector<PixelState>;
  // Not done: 2, 4, 6, 8 with the median 5; done: 1, 5, 5.1, 100.
  const States states{refining, at_maximum, refining, refining, done, done, done, done};
  const std::vector<float> truth{2, 4, 6, 8, 1, 5, 5.1f, 100};
  const FalseStops stops = false_stops(states, truth);
  EXPECT_EQ(stops.not_done, 4u);
  EXPECT_EQ(stops.done, 4u);
  EXPECT_EQ(stops.wrong, 2u);
  EXPECT_DOUBLE_EQ(stops.share(), 0.5);
  EXPECT_TRUE(std::isnan(false_stops(States{done}, std::vector<float>{1}).share()));
  EXPECT_TRUE(std::isnan(false_stops(States{refining}, std::vector<float>{1}).share()));
  // An odd number has one in the middle.
  EXPECT_EQ(
      false_stops(States{refining, refining, refining, done}, std::vector<float>{1, 5, 9, 6}).wrong,
      1u);
}

TEST(ShareDistance, IsZeroForTheSameSharesAndOneForDisjointOnes) {
  using Counts = std::vector<std::uint32_t>;
  using Weights = std::vector<float>;
  EXPECT_DOUBLE_EQ(share_distance(Counts{2, 4, 6}, Weights{0.5f, 1, 1.5f}), 0.0);
  EXPECT_DOUBLE_EQ(share_distance(Counts{3, 0, 0}, Weights{0, 1, 2}), 1.0);
  // Shares ½ ½ against ¼ ¾.
  EXPECT_DOUBLE_EQ(share_distance(Counts{1, 1}, Weights{1, 3}), 0.25);
  EXPECT_TRUE(std::isnan(share_distance(Counts{0}, Weights{1})));
}

TEST(OracleWeights, AreTheRootOfTheVarianceOfOneSample) {
  Film film(3, 1, {.variance = true});
  film.add(0, std::vector<glm::vec3>{{0, 0, 0}, {2, 0, 0}});  // s² = 2
  film.add(1, std::vector<glm::vec3>(8, glm::vec3(5.0f)));
  std::vector<glm::vec3> samples(50, glm::vec3(1.0f));  // s² = 50/49 in each of three channels
  for (std::size_t i = 1; i < samples.size(); i += 2) {
    samples[i] = glm::vec3(3.0f);
  }
  film.add(2, samples);
  const auto weights = oracle_weights(film);
  EXPECT_NEAR(weights[0], std::sqrt(2.0), 1e-6);
  EXPECT_EQ(weights[1], 0.0f);
  EXPECT_NEAR(weights[2], std::sqrt(3.0 * 50.0 / 49.0), 1e-6);
}

TEST(OracleWeights, SpreadSamplesWithLessErrorThanAnyOtherTried) {
  const std::vector<double> deviations{0.1, 1.0, 3.0, 0.5};
  const auto error = [&](const std::vector<double>& shares) {
    double sum = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      sum += deviations[i] * deviations[i] / shares[i];
    }
    return sum;
  };
  std::vector<double> best = deviations;
  for (double& share : best) {
    share /= 4.6;
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> factor(0.5, 2.0);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> other = best;
    double total = 0.0;
    for (double& share : other) total += share *= factor(random);
    for (double& share : other) share /= total;
    EXPECT_GE(error(other), error(best));
  }
}

/// A source that does not vary on the left half of the picture.
SampleSource half_noise() {
  return [](int x, int y, std::uint32_t first, std::span<glm::vec3> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      std::mt19937 random(unsigned(x + 100 * y) * 7919u + first + unsigned(i));
      out[i] = glm::vec3(x < 8 ? 0.5f : float(random() % 1000) / 500.0f);
    }
  };
}

TEST(EstimatorQuality, OfALaneFollowsItsParts) {
  LaneSettings settings = default_settings(EstimatorId::contrast);
  Lab lab(half_noise(), 16, 8, std::span(&settings, 1));
  for (int i = 0; i < 5; ++i) {
    lab.run_pass();
  }
  const Lane& lane = lab.lanes()[0];
  const std::vector<float> scaled = largest_scaled_errors(lane);
  ASSERT_EQ(scaled.size(), 128u);
  std::size_t not_done = 0;
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    float most = 0.0f;
    for (std::size_t c = 0; c < 3; ++c) {
      most = std::max(most, lane.error()[c * 128 + i] / settings.thresholds[c]);
    }
    EXPECT_NEAR(scaled[i], most, 1e-6);
    not_done += scaled[i] > 1.0f ? 1 : 0;
  }
  EXPECT_EQ(not_done, lane.history().back().not_done);
  std::vector<float> truth(128);
  for (std::size_t i = 0; i < 128; ++i) {
    const float off = lane.film().mean(0)[i] - (i % 16 < 8 ? 0.5f : 1.0f);
    truth[i] = off * off;
  }
  const EstimatorQuality quality = quality_of(lane, truth);
  EXPECT_EQ(quality.stops.not_done, not_done);
  EXPECT_DOUBLE_EQ(quality.rank_correlation, rank_correlation(scaled, truth));
  EXPECT_GT(quality.rank_correlation, 0.5);
  EXPECT_FALSE(quality.calibration.empty());

  settings = default_settings(EstimatorId::uniform);
  Lab plain(half_noise(), 16, 8, std::span(&settings, 1));
  plain.run_pass();
  EXPECT_TRUE(std::isnan(quality_of(plain.lanes()[0], truth).rank_correlation));
  EXPECT_TRUE(quality_of(plain.lanes()[0], truth).calibration.empty());
}

TEST(EstimatorQuality, APixelWithFewerSamplesThanTheMinimumIsNotDone) {
  LaneSettings settings = default_settings(EstimatorId::cycles);
  settings.thresholds[0] =
      100.0f;  // above every error: only the minimum keeps pixels from being done
  settings.policy.kind = PolicyId::vote;
  ASSERT_EQ(minimum_samples(settings), 5u);
  Lab lab(half_noise(), 16, 8, std::span(&settings, 1));
  lab.run_pass();
  ASSERT_LT(std::ranges::max(lab.lanes()[0].taken()), 5u);
  const std::vector<float> even(128, 1.0f);
  EXPECT_EQ(quality_of(lab.lanes()[0], even).stops.done, 0u);
  EXPECT_EQ(quality_of(lab.lanes()[0], even).stops.not_done, 128u);
}

}  // namespace
}  // namespace quartet
