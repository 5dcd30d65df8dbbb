#include "renderer/adaptive/policies/policy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/policy_parameter.h"

namespace quartet {
namespace {

/// A picture whose errors are given and that has taken one sample everywhere.
struct Picture {
  int width;
  int height;
  std::vector<float> error;
  std::vector<std::uint32_t> taken;

  Picture(int w, int h, int channels = 1)
      : width(w),
        height(h),
        error(std::size_t(w) * std::size_t(h) * std::size_t(channels), 0.0f),
        taken(std::size_t(w) * std::size_t(h), 1) {}

  Plan plan(const LaneSettings& settings, std::uint32_t pass = 1) const {
    Plan plan;
    plan_next(settings, {width, height, error, taken, pass}, plan);
    return plan;
  }
};

LaneSettings kl_settings(float multiplier) {
  LaneSettings settings = default_settings(EstimatorId::kl);
  settings.policy.multiplier = multiplier;
  return settings;
}

TEST(Vote, FirstPassIsOneSampleEverywhere) {
  Picture picture(5, 4);
  std::fill(picture.taken.begin(), picture.taken.end(), 0u);
  picture.error.clear();
  const Plan plan = picture.plan(kl_settings(0.5f), 0);
  EXPECT_EQ(plan.wanted, std::vector<std::uint16_t>(20, 1));
  EXPECT_EQ(plan.total, 20u);
  EXPECT_EQ(plan.not_done, 20u);
}

TEST(Vote, APixelVotesForItsNeighbourhood) {
  Picture picture(5, 5);
  picture.error[12] = 1.0f;
  const Plan plan = picture.plan(kl_settings(1.0f));
  EXPECT_EQ(plan.not_done, 1u);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      const bool near = std::abs(x - 2) <= 1 && std::abs(y - 2) <= 1;
      EXPECT_EQ(plan.wanted[std::size_t(5) * std::size_t(y) + std::size_t(x)], near ? 2 : 1);
    }
  }
  EXPECT_EQ(plan.total, 25u + 9u);
}

TEST(Vote, AFireflyInTheReport) {
  // A firefly raises the error of all nine windows that hold it. With the multiplier of the
  // report's text it gets nine extra samples, with that of its pictures four.
  Picture picture(5, 5);
  for (int y = 1; y <= 3; ++y) {
    for (int x = 1; x <= 3; ++x) {
      picture.error[std::size_t(5) * std::size_t(y) + std::size_t(x)] = 1.0f;
    }
  }
  EXPECT_EQ(picture.plan(kl_settings(1.0f)).wanted[12], 1 + 9);
  EXPECT_EQ(picture.plan(kl_settings(0.5f)).wanted[12], 1 + 4);
}

TEST(Vote, BordersHaveFewerVoters) {
  Picture picture(3, 3);
  std::fill(picture.error.begin(), picture.error.end(), 1.0f);
  const Plan plan = picture.plan(kl_settings(1.0f));
  EXPECT_EQ(plan.wanted, (std::vector<std::uint16_t>{5, 7, 5, 7, 10, 7, 5, 7, 5}));
  Picture single(1, 1);
  single.error[0] = 1.0f;
  EXPECT_EQ(single.plan(kl_settings(1.0f)).wanted[0], 2);
}

TEST(Vote, ErrorAtTheThresholdIsDone) {
  Picture picture(1, 1);
  const LaneSettings settings = kl_settings(1.0f);
  picture.error[0] = settings.thresholds[0];
  EXPECT_EQ(picture.plan(settings).not_done, 0u);
  picture.error[0] = std::nextafter(settings.thresholds[0], 1.0f);
  EXPECT_EQ(picture.plan(settings).not_done, 1u);
}

TEST(Vote, EachChannelOfContrastHasItsThreshold) {
  const LaneSettings settings = default_settings(EstimatorId::contrast);
  for (std::size_t c = 0; c < 3; ++c) {
    Picture picture(1, 1, 3);
    picture.error[c] = settings.thresholds[c];
    EXPECT_EQ(picture.plan(settings).not_done, 0u) << c;
    picture.error[c] = settings.thresholds[c] + 0.01f;
    EXPECT_EQ(picture.plan(settings).not_done, 1u) << c;
  }
}

TEST(Vote, StochasticRoundingKeepsTheMean) {
  // One vote at multiplier 0.5: each pixel draws one extra sample with probability ½. Over n = 90
  // 000 pixels of nine planned passes the share lies within 4 standard deviations (false alarm
  // 6e-5).
  Picture picture(100, 100);
  LaneSettings settings = kl_settings(0.5f);
  settings.policy.stochastic_rounding = true;
  for (std::size_t y = 1; y < 100; y += 3) {
    for (std::size_t x = 1; x < 100; x += 3) {
      picture.error[100 * y + x] = 1.0f;
    }
  }
  std::uint64_t extra = 0;
  std::uint64_t voted = 0;
  for (std::uint32_t pass = 1; pass <= 9; ++pass) {
    extra += picture.plan(settings, pass).total - 10'000;
    voted += 9801;  // 99 x 99
  }
  const double share = double(extra) / double(voted);
  EXPECT_NEAR(share, 0.5, 4.0 * 0.5 / std::sqrt(double(voted)));
  EXPECT_NE(picture.plan(settings, 1).wanted, picture.plan(settings, 2).wanted);
  EXPECT_EQ(picture.plan(settings, 1).wanted, picture.plan(settings, 1).wanted);
}

TEST(Vote, NoPixelPassesTheMaximum) {
  Picture picture(2, 1);
  picture.error = {1.0f, 1.0f};
  LaneSettings settings = kl_settings(2.0f);
  settings.max_spp = 7;
  picture.taken = {4, 7};
  EXPECT_EQ(picture.plan(settings).wanted, (std::vector<std::uint16_t>{3, 0}));
  EXPECT_EQ(picture.plan(settings).total, 3u);
}

TEST(Vote, UniformNeverAsksForMore) {
  Picture picture(4, 4);
  picture.error.clear();
  EXPECT_EQ(picture.plan(default_settings(EstimatorId::uniform), 3).wanted,
            std::vector<std::uint16_t>(16, 1));
}

LaneSettings kl_settings(PolicyId kind) {
  LaneSettings settings = default_settings(EstimatorId::kl);
  settings.policy.kind = kind;
  return settings;
}

using Counts = std::vector<std::uint16_t>;

TEST(TwoLevel, LooksOnce) {
  const LaneSettings settings = kl_settings(PolicyId::two_level);
  Picture picture(3, 1);
  picture.error = {1.0f, 0.0f, 1.0f};
  EXPECT_EQ(picture.plan(settings, 0).wanted, (Counts{1, 1, 1}));
  const Plan second = picture.plan(settings, 1);
  EXPECT_EQ(second.wanted, (Counts{8, 0, 8}));
  EXPECT_EQ(second.not_done, 2u);
  EXPECT_EQ(picture.plan(settings, 2).total, 0u);
  EXPECT_EQ(picture.plan(settings, 2).not_done, 2u) << "though they get nothing";
}

TEST(Batch, GoesOnUntilNoErrorIsAboveTheThreshold) {
  LaneSettings settings = kl_settings(PolicyId::batch);
  settings.max_spp = 20;
  Picture picture(3, 1);
  picture.taken = {0, 0, 0};
  EXPECT_EQ(picture.plan(settings, 0).wanted, (Counts{8, 8, 8}));
  picture.taken = {8, 8, 8};
  picture.error = {1.0f, 0.0f, 1.0f};
  EXPECT_EQ(picture.plan(settings, 1).wanted, (Counts{8, 0, 8}));
  picture.taken = {16, 8, 16};
  picture.error = {1.0f, 0.0f, 0.0f};
  EXPECT_EQ(picture.plan(settings, 2).wanted, (Counts{4, 0, 0})) << "up to the maximum";
  picture.error = {0.0f, 0.0f, 0.0f};
  EXPECT_EQ(picture.plan(settings, 3).total, 0u);
}

TEST(Converge, GivesTheNeighboursOfAPixelThatIsNotDoneSamplesToo) {
  const LaneSettings settings = kl_settings(PolicyId::converge);
  Picture picture(5, 5);
  picture.error[0] = 1.0f;
  EXPECT_EQ(picture.plan(settings, 0).wanted, Counts(25, 16));
  const Plan plan = picture.plan(settings, 1);
  EXPECT_EQ(plan.not_done, 1u);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      EXPECT_EQ(plan.wanted[std::size_t(5) * std::size_t(y) + std::size_t(x)],
                x <= 1 && y <= 1 ? 8 : 0);
    }
  }
}

TEST(Tables, WithoutAnErrorAllPixelsAreAlikeUnderEachPolicy) {
  for (const PolicyRow& row : policies()) {
    LaneSettings settings = default_settings(EstimatorId::uniform);
    settings.policy.kind = row.key;
    Picture picture(4, 4);
    picture.error.clear();
    EXPECT_EQ(picture.plan(settings, 3).wanted, Counts(16, 1)) << row.id;
  }
}

TEST(Tables, APolicyReadsTheParametersThatItsRowSays) {
  const Policy unusual{.first = 5, .batch = 5, .multiplier = 0.3f, .stochastic_rounding = true};
  for (const PolicyRow& row : policies()) {
    LaneSettings settings = default_settings(EstimatorId::kl);
    settings.policy.kind = row.key;
    Picture picture(9, 9);
    std::fill(picture.error.begin(), picture.error.end(), 1.0f);
    const auto plans = [&](const Policy& policy) {
      LaneSettings other = settings;
      other.policy = policy;
      return std::pair(picture.plan(other, 0).wanted, picture.plan(other, 1).wanted);
    };
    const auto usual = plans(settings.policy);
    const auto changes = [&](auto set) {
      Policy other = settings.policy;
      set(other);
      return plans(other) != usual;
    };
    SCOPED_TRACE(row.id);
    for (const PolicyParameter& parameter : policy_parameters()) {
      SCOPED_TRACE(parameter.id);
      EXPECT_EQ(changes([&](Policy& other) { copy_parameter(parameter, unusual, other); }),
                reads(row, parameter.key));
      EXPECT_EQ(reads(settings, parameter.key), reads(row, parameter.key));
      LaneSettings uniform = settings;
      uniform.estimator = EstimatorId::uniform;
      EXPECT_FALSE(reads(uniform, parameter.key));
    }
  }
}

TEST(Tables, IdsAreUniqueAndFound) {
  for (const Estimator& row : estimators()) {
    EXPECT_EQ(&find_estimator(row.id), &row);
    EXPECT_EQ(&estimator(row.key), &row);
    EXPECT_FALSE(row.source.empty());
  }
  for (const PolicyRow& row : policies()) {
    EXPECT_EQ(&find_policy(row.id), &row);
    EXPECT_EQ(&policy(row.key), &row);
  }
  for (const PolicyParameter& row : policy_parameters()) {
    EXPECT_EQ(&policy_parameter(row.key), &row);
  }
  try {
    find_estimator("kll");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "unknown estimator 'kll'; there are: contrast, kl, chi2, hellinger, confidence, "
                 "variance, half-buffer, cycles, rigau-kl, rigau-chi2, rigau-hellinger, oracle, "
                 "uniform, uniform-clamp");
  }
}

}  // namespace
}  // namespace quartet
