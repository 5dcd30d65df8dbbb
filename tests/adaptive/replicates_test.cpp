#include "renderer/adaptive/film/replicates.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "renderer/adaptive/estimators/estimator.h"
#include "renderer/adaptive/film/film.h"
#include "renderer/adaptive/lab.h"
#include "tests/trace/statistics.h"

namespace quartet {
namespace {

using SequenceCounts = std::array<std::uint32_t, sampler_replicates>;

Replicates replicates_of(const SequenceCounts& counts, const std::array<double, 4>& means) {
  Replicates replicates;
  replicates.counts = counts;
  for (std::size_t r = 0; r < means.size(); ++r) {
    replicates.means[r] = glm::dvec3(means[r]);
  }
  return replicates;
}

TEST(Replicates, AddSamplesInTurn) {
  Replicates replicates;
  for (std::uint32_t i = 0; i < 6; ++i) {
    replicates.add(i, glm::dvec3(double(i), 1.0, 2.0 * double(i)));
  }
  EXPECT_EQ(replicates.counts, (SequenceCounts{2, 2, 1, 1}));
  EXPECT_EQ(replicates.means[0], glm::dvec3(2.0, 1.0, 4.0));
  EXPECT_EQ(replicates.means[1], glm::dvec3(3.0, 1.0, 6.0));
  EXPECT_EQ(replicates.means[3], glm::dvec3(3.0, 1.0, 6.0));
}

TEST(Replicates, OfEqualLengthGiveTheTextbooksVariance) {
  const MeanVariance variance = variance_of_mean(replicates_of({8, 8, 8, 8}, {1.0, 2.0, 4.0, 9.0}));
  // Deviations from 4: 9 + 4 + 0 + 25, over 4 · 3.
  EXPECT_NEAR(variance.channels.y, 38.0 / 12.0, 1e-14);
  EXPECT_NEAR(variance.luminance, 38.0 / 12.0, 1e-14);
  EXPECT_EQ(variance.freedom, 3u);
}

TEST(Replicates, SingleSamplesGiveSSquaredOverN) {
  // Of different sequences, samples are independent.
  EXPECT_NEAR(variance_of_mean(replicates_of({1, 1, 0, 0}, {1.0, 4.0, 0, 0})).channels.x, 4.5 / 2.0,
              1e-14);
  EXPECT_EQ(variance_of_mean(replicates_of({1, 1, 0, 0}, {1.0, 4.0, 0, 0})).freedom, 1u);
  EXPECT_NEAR(variance_of_mean(replicates_of({1, 0, 1, 1}, {1.0, 0, 4.0, 7.0})).channels.x,
              9.0 / 3.0, 1e-14);
  EXPECT_EQ(variance_of_mean(replicates_of({1, 0, 1, 1}, {1.0, 0, 4.0, 7.0})).freedom, 2u);
}

TEST(Replicates, SayWhenTheyDoNotKnow) {
  for (const SequenceCounts& counts :
       {SequenceCounts{0, 0, 0, 0}, SequenceCounts{1, 0, 0, 0}, SequenceCounts{5, 0, 0, 0},
        SequenceCounts{2, 1, 0, 0}, SequenceCounts{9, 4, 2, 2}}) {
    const MeanVariance variance = variance_of_mean(replicates_of(counts, {1.0, 2.0, 3.0, 4.0}));
    EXPECT_EQ(variance.freedom, 0u) << counts[0];
    EXPECT_EQ(variance.channels, glm::dvec3(0.0));
  }
  // Half of all is not more than half.
  EXPECT_EQ(variance_of_mean(replicates_of({4, 2, 1, 1}, {1.0, 2.0, 3.0, 4.0})).freedom, 1u);
}

// However many samples the sequences have, and however their variances fall with them, the estimate
// is right in the mean: E (m_r − m)² is known, so that the expectation follows from the estimates
// of unit vectors.
TEST(Replicates, AreUnbiasedForEveryLawOfVariance) {
  std::mt19937 random(3);
  for (const SequenceCounts& counts :
       {SequenceCounts{2, 1, 1, 1}, SequenceCounts{2, 2, 1, 1}, SequenceCounts{3, 2, 2, 2},
        SequenceCounts{9, 9, 9, 8}, SequenceCounts{4, 2, 1, 1}, SequenceCounts{1, 1, 1, 0},
        SequenceCounts{7, 3, 0, 5}, SequenceCounts{10, 9, 1, 0}}) {
    double n = 0.0;
    for (const std::uint32_t count : counts) {
      n += double(count);
    }
    for (const double power : {0.0, 1.0, 1.6, 3.0}) {
      // The estimate is a quadratic form Σ A_rs m_r m_s of independent means with the same
      // expectation: its own is Σ A_rr σ_r², because it is 0 for equal means.
      double expected = 0.0;
      double truth = 0.0;
      for (std::size_t r = 0; r < counts.size(); ++r) {
        std::array<double, 4> unit{};
        unit[r] = 1.0;
        const double sigma = counts[r] > 0 ? std::pow(double(counts[r]), -power) : 0.0;
        expected += variance_of_mean(replicates_of(counts, unit)).channels.x * sigma;
        const double w = double(counts[r]) / n;
        truth += w * w * sigma;
      }
      EXPECT_NEAR(expected / truth, 1.0, 1e-12) << counts[0] << counts[1] << " " << power;
    }
    EXPECT_EQ(variance_of_mean(replicates_of(counts, {0.1, 0.1, 0.1, 0.1})).luminance, 0.0);
  }
}

constexpr FilmStatistics kept{.variance = true, .chi2 = true, .replicated = true};

TEST(ReplicatedFilm, KeepsWhatItsSequencesMean) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(0.0f, 2.0f);
  std::vector<glm::vec3> samples(23);
  for (glm::vec3& sample : samples) {
    sample = {uniform(random), uniform(random), uniform(random)};
  }
  samples[6].x = std::numeric_limits<float>::quiet_NaN();
  Replicates expected;
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    if (i != 6) {
      expected.add(i, glm::dvec3(samples[i]));
    }
  }
  Film film(1, 1, kept);
  film.add(0, std::span(samples).first(9));
  film.add(0, std::span(samples).subspan(9));
  const MeanVariance variance = variance_of_mean(expected);
  EXPECT_EQ(film.variance_of_mean(0), variance.channels);
  const LuminanceDeviations deviations = film.luminance_deviations(0);
  EXPECT_EQ(deviations.freedom, 3u);
  EXPECT_NEAR(deviations.squares / (3.0 * 22.0) / variance.luminance, 1.0, 1e-12);
  // As published without.
  Film plain(1, 1, {.chi2 = true});
  plain.add(0, samples);
  EXPECT_EQ(plain.luminance_deviations(0).freedom, 21u);
  EXPECT_EQ(plain.luminance_deviations(0).squares, plain.spread(Divergence::chi2, 0));
}

TEST(ReplicatedFilm, TakesMemoryOnlyWhereAVarianceIsAskedFor) {
  const std::vector<glm::vec3> samples(4, glm::vec3(1.0f));
  const auto bytes = [&](FilmStatistics statistics) {
    Film film(10, 10, statistics);
    film.add(0, samples);
    return film.bytes();
  };
  EXPECT_EQ(bytes({.replicated = true}), bytes({}));
  EXPECT_FALSE(FilmStatistics{.replicated = true}.any()) << "its means can be looked up";
  EXPECT_EQ(bytes({.kl = true, .replicated = true}), bytes({.kl = true}));
  for (const FilmStatistics& asks : {FilmStatistics{.variance = true}, {.chi2 = true}}) {
    FilmStatistics replicated = asks;
    replicated.replicated = true;
    EXPECT_EQ(bytes(replicated), bytes(asks) + 100 * sizeof(Replicates));
  }
  Film film(10, 10, kept);
  film.restart({});
  EXPECT_EQ(film.bytes(), Film(10, 10).bytes());
}

/// 16 samples that agree within each sequence: that many equal pairs, triples, … of four numbers.
std::vector<glm::vec3> stratified(const std::array<float, 4>& numbers) {
  std::vector<glm::vec3> samples;
  for (std::uint32_t i = 0; i < 16; ++i) {
    samples.emplace_back(numbers[i % 4]);
  }
  return samples;
}

TEST(ReplicatedFilm, IsWhatEstimatorsOfAVarianceJudgeBy) {
  const std::vector<glm::vec3> samples = stratified({1.0f, 2.0f, 4.0f, 9.0f});
  const double of_mean = 38.0 / 12.0;
  const double mean = 4.0;
  const auto error = [&](EstimatorId id, bool replicated) {
    const Estimator& row = estimator(id);
    FilmStatistics needs = row.needs;
    needs.replicated = replicated;
    Film film(1, 1, needs);
    film.add(0, samples);
    float found = -1.0f;
    row.estimate({film}, std::span(&found, 1));
    return double(found);
  };
  EXPECT_NEAR(error(EstimatorId::confidence, true), 3.182446305 * std::sqrt(of_mean) / mean, 1e-6);
  EXPECT_NEAR(error(EstimatorId::variance, true), of_mean * 3.0 / 0.3518463177, 1e-5);
  EXPECT_NEAR(error(EstimatorId::rigau_chi2, true), std::sqrt(of_mean * 15.0 / 16.0 / 16.0), 1e-6);
  for (const EstimatorId id : {EstimatorId::rigau_kl, EstimatorId::rigau_hellinger}) {
    EXPECT_EQ(error(id, true), error(id, false));
  }
  // Had they been independent, the same samples would show 16 · 38 / 4 over 16 · 15.
  EXPECT_NEAR(error(EstimatorId::rigau_chi2, false), std::sqrt(38.0 / 4.0) / 16.0, 1e-6);
}

TEST(ReplicatedFilm, IsNotJudgedBeforeItsVarianceIsKnown) {
  for (const EstimatorId id :
       {EstimatorId::confidence, EstimatorId::variance, EstimatorId::rigau_chi2}) {
    const Estimator& row = estimator(id);
    FilmStatistics needs = row.needs;
    needs.replicated = true;
    Film film(1, 1, needs);
    // Three of one sequence: the others were rejected.
    std::vector<glm::vec3> samples(9, glm::vec3(-1.0f));
    samples[0] = samples[4] = samples[8] = glm::vec3(1.0f);
    film.add(0, samples);
    ASSERT_EQ(film.counts()[0], 3u);
    float error = 0.0f;
    row.estimate({film}, std::span(&error, 1));
    EXPECT_TRUE(std::isinf(error)) << row.id;
  }
}

TEST(ReplicatedFilm, IsThatOfALanesWhoseLabSaysSo) {
  const SampleSource source([](int, int, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      radiance[i] = glm::vec3(float((first + i) % 4));
    }
  });
  for (const SamplerRow& row : samplers()) {
    for (const SampleModeRow& mode : sample_modes()) {
      SCOPED_TRACE(std::string(row.id) + " " + std::string(mode.id));
      LabOptions options;
      options.sampler = row.key;
      options.statistics.variance = true;
      options.pilot_source = source;
      std::array lanes{default_settings(EstimatorId::confidence),
                       default_settings(EstimatorId::kl)};
      lanes[0].mode = lanes[1].mode = mode.key;
      Lab lab(source, 3, 2, lanes, options);
      ASSERT_TRUE(lab.run_pass());
      const bool replicated = row.key == SamplerId::replicated;
      for (const Lane& lane : lab.lanes()) {
        EXPECT_EQ(lane.film().statistics().replicated, replicated);
      }
      EXPECT_EQ(lab.lanes()[0].deciding_film().luminance_deviations(0).freedom,
                replicated ? 3u : 7u);
      // Without a variance to keep, means are looked up under every sampler.
      options.statistics = {};
      lanes[0] = lanes[1];
      Lab plain(source, 3, 2, lanes, options);
      ASSERT_TRUE(plain.run_pass());
      EXPECT_FALSE(plain.lanes()[0].film().has_sums());
    }
  }
}

}  // namespace
}  // namespace quartet
