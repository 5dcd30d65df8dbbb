// Several passes at once give, to the bit, what pass after pass gives.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/adaptive/lab.h"
#include "renderer/base/math/hash_mix.h"

namespace quartet {
namespace {

struct ReplayPicture {
  int width;
  int height;
};

/// Noise that differs from one pixel and sample to the next, brighter downwards; where `bad`, some
/// samples of some tiles are negative.
SampleSource replay_noise(bool bad) {
  return [bad](int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::uint32_t i = 0; i < radiance.size(); ++i) {
      const std::uint64_t bits =
          hash_mix((std::uint64_t(y) << 40) + (std::uint64_t(x) << 20) + first + i + 1);
      const auto part = [bits](int shift) { return float(bits >> shift & 0xffff) * 0x1p-16f; };
      radiance[i] = glm::vec3(part(0), part(16), part(32)) * (0.05f + 0.01f * float(y % 50));
      if (bad && x % 37 == 3 && (first + i) % 5 == 2) {
        radiance[i].y = -1.0f;
      }
    }
  };
}

Lab replay_lab(ReplayPicture picture, std::span<const LaneSettings> lane_settings, bool bad,
               int threads = 2, std::size_t memory = LabOptions().memory) {
  LabOptions options;
  options.threads = threads;
  options.memory = memory;
  options.pilot_source = replay_noise(false);
  return Lab(replay_noise(bad), picture.width, picture.height, lane_settings, options);
}

/// Those whose lanes are replayed several passes at once, under every policy.
std::vector<LaneSettings> replayed_settings() {
  std::vector<LaneSettings> lane_settings;
  for (const Estimator& row : estimators()) {
    if (row.window) {
      for (const PolicyRow& policy : policies()) {
        LaneSettings settings = default_settings(row.key);
        settings.policy.kind = policy.key;
        settings.policy.stochastic_rounding = lane_settings.size() % 3 == 0;
        settings.max_spp = lane_settings.size() % 2 == 0 ? 23 : 1u << 16;
        lane_settings.push_back(settings);
      }
    }
  }
  return lane_settings;
}

void expect_same(const Lane& lane, const Lane& expected) {
  ASSERT_EQ(lane.pass(), expected.pass());
  for (int c = 0; c < 3; ++c) {
    EXPECT_TRUE(std::ranges::equal(lane.film().mean(c), expected.film().mean(c)));
  }
  EXPECT_TRUE(std::ranges::equal(lane.film().counts(), expected.film().counts()));
  EXPECT_TRUE(std::ranges::equal(lane.film().rejected(), expected.film().rejected()));
  EXPECT_TRUE(std::ranges::equal(lane.taken(), expected.taken()));
  EXPECT_TRUE(std::ranges::equal(lane.error(), expected.error()));
  EXPECT_EQ(lane.plan().wanted, expected.plan().wanted);
  EXPECT_EQ(lane.plan().total, expected.plan().total);
  EXPECT_EQ(lane.plan().not_done, expected.plan().not_done);
  ASSERT_EQ(lane.history().size(), expected.history().size());
  for (std::size_t i = 0; i < lane.history().size(); ++i) {
    const PassRecord& record = lane.history()[i];
    const PassRecord& right = expected.history()[i];
    EXPECT_EQ(record.pass, right.pass);
    EXPECT_EQ(record.samples, right.samples);
    EXPECT_EQ(record.not_done, right.not_done);
    EXPECT_EQ(record.max_spp, right.max_spp);
    EXPECT_EQ(record.rays, right.rays);
  }
}

void run_by_pass(Lab& lab, std::uint32_t passes) {
  while (lab.pass() < passes) {
    ASSERT_TRUE(lab.run_pass());
  }
}

/// Returns how often it took to get there.
int run_at_once(Lab& lab, std::uint32_t passes) {
  int steps = 0;
  for (; lab.pass() < passes && lab.run_passes(passes); ++steps) {
  }
  return steps;
}

void restart_lanes(Lab& lab, std::span<const LaneSettings> lane_settings) {
  for (std::size_t i = 0; i < lane_settings.size(); ++i) {
    lab.set_settings(i, lane_settings[i]);
  }
}

TEST(Replay, IsTheSamePassByPassAndAtOnce) {
  constexpr std::uint32_t passes = 9;
  const std::vector<LaneSettings> lane_settings = replayed_settings();
  ASSERT_GE(lane_settings.size(), 16u);
  // Of one row, of one column, of tiles that are cut, and of several bands.
  for (const auto& [width, height] :
       {ReplayPicture{1, 1}, ReplayPicture{1, 40}, ReplayPicture{40, 1}, ReplayPicture{2, 2},
        ReplayPicture{9, 17}, ReplayPicture{61, 200}}) {
    for (const bool bad : {false, true}) {
      SCOPED_TRACE(fmt::format("{} x {}, {}", width, height, bad));
      Lab lab = replay_lab({width, height}, lane_settings, bad, 5);
      Lab expected = replay_lab({width, height}, lane_settings, bad);
      run_by_pass(lab, passes);
      run_by_pass(expected, passes);
      restart_lanes(lab, lane_settings);
      EXPECT_LT(run_at_once(lab, passes), int(passes));
      for (std::size_t i = 0; i < lane_settings.size(); ++i) {
        SCOPED_TRACE(i);
        expect_same(lab.lanes()[i], expected.lanes()[i]);
      }
      EXPECT_EQ(lab.store().traced(), expected.store().traced());
    }
  }
}

TEST(Replay, GoesAsFarAsThereAreSamplesAndThenTraces) {
  constexpr std::uint32_t passes = 8;
  constexpr ReplayPicture picture{61, 150};
  for (const Estimator& row : estimators()) {
    if (!row.window) {
      continue;
    }
    SCOPED_TRACE(row.id);
    LaneSettings greedy = default_settings(row.key);
    LaneSettings modest = greedy;
    for (float& threshold : modest.thresholds) {
      threshold *= 20.0f;
    }
    Lab lab = replay_lab(picture, std::span(&modest, 1), false);
    run_by_pass(lab, passes);
    lab.set_settings(0, greedy);
    run_at_once(lab, passes);
    Lab expected = replay_lab(picture, std::span(&greedy, 1), false);
    run_by_pass(expected, passes);
    expect_same(lab.lanes()[0], expected.lanes()[0]);
    EXPECT_GT(expected.lanes()[0].history().back().samples,
              std::uint64_t(picture.width * picture.height) * passes);
  }
}

/// A lane of every kind, of which not all can be replayed at once.
TEST(Replay, LanesThatGoPassByPassComeAfter) {
  constexpr std::uint32_t passes = 7;
  constexpr ReplayPicture picture{30, 70};
  std::vector<LaneSettings> lane_settings{
      default_settings(EstimatorId::kl), default_settings(EstimatorId::uniform),
      default_settings(EstimatorId::contrast), default_settings(EstimatorId::contrast)};
  lane_settings[3].mode = SampleMode::unbiased;
  Lab lab = replay_lab(picture, lane_settings, false);
  Lab expected = replay_lab(picture, lane_settings, false);
  run_by_pass(lab, passes);
  run_by_pass(expected, passes);
  restart_lanes(lab, lane_settings);
  run_at_once(lab, passes);
  for (std::size_t i = 0; i < lane_settings.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(lab.lanes()[i], expected.lanes()[i]);
  }
}

TEST(Replay, GoesOnFromWhereALaneStands) {
  constexpr ReplayPicture picture{50, 64};
  const LaneSettings settings = default_settings(EstimatorId::hellinger);
  Lab lab = replay_lab(picture, std::span(&settings, 1), true);
  Lab expected = replay_lab(picture, std::span(&settings, 1), true);
  run_by_pass(lab, 12);
  run_by_pass(expected, 12);
  restart_lanes(lab, std::span(&settings, 1));
  run_by_pass(lab, 3);
  run_at_once(lab, 7);
  run_by_pass(lab, 8);
  run_at_once(lab, 12);
  expect_same(lab.lanes()[0], expected.lanes()[0]);
}

TEST(Replay, SamplesAreAddedToWhatWasReplayed) {
  constexpr ReplayPicture picture{50, 64};
  const LaneSettings settings = default_settings(EstimatorId::kl);
  Lab expected = replay_lab(picture, std::span(&settings, 1), true);
  run_by_pass(expected, 6);
  Lab lab = replay_lab(picture, std::span(&settings, 1), true, 2, 2 * expected.store().bytes());
  run_by_pass(lab, 6);
  restart_lanes(lab, std::span(&settings, 1));
  run_at_once(lab, 6);
  EXPECT_TRUE(lab.store().has_means());
  run_by_pass(lab, 15);
  EXPECT_FALSE(lab.store().has_means());
  run_by_pass(expected, 15);
  expect_same(lab.lanes()[0], expected.lanes()[0]);
}

TEST(Replay, ChargesEveryPassOfIt) {
  constexpr ReplayPicture picture{64, 64};
  const LaneSettings settings = default_settings(EstimatorId::chi2);
  Lab lab = replay_lab(picture, std::span(&settings, 1), false);
  run_by_pass(lab, 6);
  std::vector<double> tracing;
  for (const PassRecord& record : lab.lanes()[0].history()) {
    tracing.push_back(record.tracing_seconds);
  }
  restart_lanes(lab, std::span(&settings, 1));
  run_at_once(lab, 6);
  double before = 0.0;
  for (std::size_t i = 0; i < tracing.size(); ++i) {
    const PassRecord& record = lab.lanes()[0].history()[i];
    EXPECT_EQ(record.tracing_seconds, tracing[i]);
    EXPECT_GT(record.seconds - record.tracing_seconds, before);
    before = record.seconds - record.tracing_seconds;
  }
}

}  // namespace
}  // namespace quartet
