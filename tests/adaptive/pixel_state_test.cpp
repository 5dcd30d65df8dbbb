#include "renderer/adaptive/pixel_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "renderer/adaptive/lab.h"
#include "renderer/session/snapshot.h"
#include "tests/study/noisy_source.h"

namespace quartet {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// Errors and samples of a picture, all near to where they decide something.
struct Decided {
  LaneSettings settings;
  int width;
  int height;
  std::vector<float> error;
  std::vector<std::uint32_t> taken;

  Decided(EstimatorId id, int w, int h, unsigned seed)
      : settings(default_settings(id)),
        width(w),
        height(h),
        taken(std::size_t(w) * std::size_t(h)) {
    std::mt19937 random(seed);
    for (float& threshold : settings.thresholds) {
      threshold = random() % 4 == 0 ? 0.0f : threshold;
    }
    const std::uint32_t minimum = minimum_samples(settings);
    settings.max_spp = minimum + 1 + random() % 3;
    for (std::uint32_t& samples : taken) {
      samples = minimum + std::uint32_t(random() % 6);
      samples -= std::min(samples, 2u);
    }
    error.resize(std::size_t(estimator(id).channels) * taken.size());
    for (std::size_t i = 0; i < error.size(); ++i) {
      const float threshold = settings.thresholds[i / taken.size()];
      const std::array<float, 8> choices{0.0f,
                                         threshold,
                                         std::nextafter(threshold, 0.0f),
                                         std::nextafter(threshold, infinite),
                                         0.5f * threshold,
                                         3.0f * threshold + 1e-20f,
                                         infinite,
                                         not_a_number};
      // Most are below, or no pixel of three channels would be done.
      error[i] = random() % 2 == 0 ? 0.0f : choices[random() % choices.size()];
    }
  }

  PixelCriterion criterion() const { return {settings, error, taken}; }

  bool done(std::size_t pixel) const {
    const int channels = estimator(settings.estimator).channels;
    bool above = false;
    for (std::size_t c = 0; c < std::size_t(channels); ++c) {
      above = above || error[c * taken.size() + pixel] > settings.thresholds[c];
    }
    return channels > 0 && !above && taken[pixel] >= minimum_samples(settings);
  }

  PixelState state(std::size_t pixel) const {
    return done(pixel)                        ? PixelState::done
           : taken[pixel] >= settings.max_spp ? PixelState::at_maximum
                                              : PixelState::refining;
  }

  /// Of the pixels around one, those that are not done.
  int votes(int x, int y) const {
    int sum = 0;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
        sum += done(std::size_t(v * width + u)) ? 0 : 1;
      }
    }
    return sum;
  }

  /// What the second pass takes, one pixel at a time.
  std::uint32_t wanted(PolicyId kind, int x, int y) const {
    const auto pixel = std::size_t(y * width + x);
    const bool refining = !done(pixel);
    const Estimator& row = estimator(settings.estimator);
    const std::uint32_t own = row.look_every > 0 ? row.look_every : 8;
    std::uint32_t samples = 1;
    if (row.channels > 0) {
      switch (kind) {
        case PolicyId::vote:
          samples = 1 + std::uint32_t(settings.policy.multiplier * float(votes(x, y)));
          break;
        case PolicyId::two_level:
        case PolicyId::batch:
          samples = refining ? 8 : 0;
          break;
        case PolicyId::converge:
          samples = votes(x, y) > 0 ? own : 0;
          break;
      }
    }
    return std::min(samples, settings.max_spp - std::min(settings.max_spp, taken[pixel]));
  }
};

TEST(PixelState, OfRandomErrorsIsWhatOnePixelAtATimeGives) {
  std::array<std::size_t, 3> met{};
  std::size_t done_at_maximum = 0;
  for (const Estimator& row : estimators()) {
    for (unsigned seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(testing::Message() << row.id << ", seed " << seed);
      const Decided picture(row.key, 37, 11, seed);
      const std::vector<PixelState> states = pixel_states(picture.criterion());
      ASSERT_EQ(states.size(), picture.taken.size());
      std::vector<std::uint8_t> marks(20);
      mark_not_done(picture.criterion(), 13, marks);
      for (std::size_t i = 0; i < states.size(); ++i) {
        ASSERT_EQ(states[i], picture.state(i)) << i;
        ASSERT_EQ(pixel_state(picture.criterion(), i), picture.state(i)) << i;
        if (i >= 13 && i < 33) {
          ASSERT_EQ(marks[i - 13], picture.done(i) ? 0 : 1) << i;
        }
        ++met[std::size_t(states[i])];
        done_at_maximum += picture.done(i) && picture.taken[i] >= picture.settings.max_spp ? 1 : 0;
      }
    }
  }
  EXPECT_GT(*std::ranges::min_element(met), 1000u) << "each state is met";
  EXPECT_GT(done_at_maximum, 1000u);
}

TEST(PixelState, PlansFollowIt) {
  for (const Estimator& row : estimators()) {
    for (const PolicyRow& policy : policies()) {
      for (unsigned seed = 0; seed < 6; ++seed) {
        SCOPED_TRACE(testing::Message() << row.id << ", " << policy.id << ", seed " << seed);
        // More rows than are handed to a thread at a time.
        Decided picture(row.key, 9, 70, seed);
        picture.settings.policy.kind = policy.key;
        picture.settings.max_spp += seed % 2 == 0 ? 20 : 0;
        Plan plan;
        plan_next(picture.settings,
                  {picture.width, picture.height, picture.error, picture.taken, 1}, plan);
        std::uint64_t total = 0;
        for (int y = 0; y < picture.height; ++y) {
          for (int x = 0; x < picture.width; ++x) {
            const std::uint32_t wanted = picture.wanted(policy.key, x, y);
            ASSERT_EQ(plan.wanted[std::size_t(y * picture.width + x)], wanted) << x << ", " << y;
            total += wanted;
          }
        }
        EXPECT_EQ(plan.total, total);
        const auto not_done =
            std::ranges::count_if(pixel_states(picture.criterion()),
                                  [](PixelState state) { return state != PixelState::done; });
        EXPECT_EQ(plan.not_done, std::uint64_t(not_done));
      }
    }
  }
}

TEST(PixelState, BeforeTheFirstPassNothingIsDone) {
  LaneSettings settings = default_settings(EstimatorId::contrast);
  const std::vector<std::uint32_t> taken(6, 0);
  EXPECT_EQ(pixel_states({settings, {}, taken}), std::vector<PixelState>(6, PixelState::refining));
  EXPECT_TRUE(largest_scaled_errors({settings, {}, taken}).empty());
  EXPECT_EQ(largest_scaled_error({settings, {}, taken}, 3), 0.0f);
}

TEST(PixelState, OfALaneIsThatOfItsSnapshot) {
  std::array<LaneSettings, 3> lane_settings{default_settings(EstimatorId::contrast),
                                            default_settings(EstimatorId::cycles),
                                            default_settings(EstimatorId::uniform)};
  for (LaneSettings& settings : lane_settings) {
    settings.policy.kind = PolicyId::vote;
  }
  lane_settings[0].max_spp = 8;
  constexpr int side = 16;
  Lab lab(test::noisy_source(side), side, side, lane_settings);
  for (int pass = 0; pass < 3; ++pass) {
    lab.run_pass();
  }
  Snapshot snapshot;
  copy_lanes(lab, snapshot);
  for (std::size_t lane = 0; lane < lane_settings.size(); ++lane) {
    SCOPED_TRACE(lane);
    const std::vector<PixelState> states = pixel_states(lab.lanes()[lane]);
    EXPECT_EQ(pixel_states(snapshot.lanes[lane]), states);
    EXPECT_EQ(largest_scaled_errors(snapshot.lanes[lane]),
              largest_scaled_errors(lab.lanes()[lane]));
    // The first has pixels of each state, no pixel of the others is done: one has fewer samples
    // than its minimum, one no error.
    EXPECT_EQ(std::ranges::count(states, PixelState::done) > 0, lane == 0);
    EXPECT_GT(std::ranges::count(states, PixelState::refining), 0);
  }
  EXPECT_GT(std::ranges::count(pixel_states(lab.lanes()[0]), PixelState::at_maximum), 0);
}

TEST(PixelState, HasALabel) {
  EXPECT_EQ(pixel_state_label(PixelState::done), "done");
  EXPECT_EQ(pixel_state_label(PixelState::refining), "refining");
  EXPECT_EQ(pixel_state_label(PixelState::at_maximum), "at the maximum");
}

// Every mantissa: what an exponent changes, as long as nothing overflows, is nothing.
TEST(ScaledError, IsAboveOneExactlyWhereTheErrorIsAboveTheThreshold) {
  const auto check = [](std::uint32_t bits) {
    const auto threshold = std::bit_cast<float>(bits);
    const auto above = std::bit_cast<float>(bits + 1);
    return scaled_error(above, threshold) > 1.0f && scaled_error(threshold, threshold) == 1.0f &&
           scaled_error(threshold, above) <= 1.0f;
  };
  std::uint32_t wrong = 0;
  const auto one = std::bit_cast<std::uint32_t>(1.0f);
  for (std::uint32_t i = 0; i < 1u << 23; ++i) {
    wrong += check(one + i) ? 0 : 1;
  }
  for (std::uint32_t bits = 1; bits < one; bits += 9973) {  // other exponents and subnormals
    wrong += check(bits) ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(ScaledError, OfAThresholdOfZeroIsInfiniteOrZero) {
  EXPECT_EQ(scaled_error(0.0f, 0.0f), 0.0f);
  EXPECT_EQ(scaled_error(std::numeric_limits<float>::denorm_min(), 0.0f), infinite);
  EXPECT_EQ(scaled_error(infinite, 0.0f), infinite);
  EXPECT_EQ(scaled_error(infinite, 2.0f), infinite);
  EXPECT_EQ(scaled_error(3.0f, 2.0f), 1.5f);
  for (const float threshold : {0.0f, 2.0f}) {
    EXPECT_FALSE(scaled_error(not_a_number, threshold) > 1.0f);
  }
}

TEST(ScaledError, OfAPixelIsTheLargestOfItsChannels) {
  for (const Estimator& row : estimators()) {
    if (row.channels == 0) {
      continue;
    }
    for (unsigned seed = 0; seed < 6; ++seed) {
      SCOPED_TRACE(testing::Message() << row.id << ", seed " << seed);
      const Decided picture(row.key, 23, 5, seed);
      const std::vector<float> scaled = largest_scaled_errors(picture.criterion());
      const std::size_t pixels = picture.taken.size();
      ASSERT_EQ(scaled.size(), pixels);
      for (std::size_t i = 0; i < pixels; ++i) {
        float expected = 0.0f;
        bool above = false;
        for (std::size_t c = 0; c < picture.error.size() / pixels; ++c) {
          const float error = picture.error[c * pixels + i];
          const float threshold = picture.settings.thresholds[c];
          above = above || error > threshold;
          if (!std::isnan(error)) {
            expected = std::max(expected, threshold > 0.0f ? error / threshold
                                          : error > 0.0f   ? infinite
                                                           : 0.0f);
          }
        }
        ASSERT_EQ(scaled[i], expected) << i;
        ASSERT_EQ(scaled[i] > 1.0f, above) << i;
        ASSERT_EQ(largest_scaled_error(picture.criterion(), i), expected) << i;
      }
    }
  }
}

}  // namespace
}  // namespace quartet
