#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/adaptive/lab.h"
#include "tests/study/noisy_source.h"

namespace quartet {
namespace {

constexpr int budget_width = 48;
constexpr int budget_height = 27;
constexpr std::size_t budget_pixels = std::size_t(budget_width) * budget_height;

Lab noisy_lab(const std::vector<LaneSettings>& lane_settings, LabOptions options) {
  options.pilot_source = test::noisy_source(budget_width + 1);
  return {test::noisy_source(budget_width), budget_width, budget_height, lane_settings, options};
}

void run_to(Lab& lab, std::uint32_t passes) {
  while (lab.pass() < passes) {
    ASSERT_TRUE(lab.run_pass());
  }
}

/// Takes one sample a pass and is never done; all that it is ahead it takes in its first pass.
LaneSettings one_a_pass(std::uint16_t first, SampleMode mode) {
  LaneSettings settings = default_settings(EstimatorId::contrast);
  settings.policy.kind = PolicyId::batch;
  settings.policy.first = first;
  settings.policy.batch = 1;
  settings.thresholds = {-1.0f, -1.0f, -1.0f};
  settings.mode = mode;
  return settings;
}

TEST(LabBudget, BeyondItTheLabForgetsWhatTheSlowestLaneHasUsedAndNoMore) {
  constexpr std::uint16_t ahead = 40;
  constexpr std::uint32_t passes = 150;
  for (const SampleMode mode : {SampleMode::reuse, SampleMode::unbiased}) {
    SCOPED_TRACE(sample_mode(mode).id);
    // The slowest is in the middle.
    const std::vector<LaneSettings> lane_settings{one_a_pass(ahead, mode), one_a_pass(1, mode),
                                                  one_a_pass(ahead / 2, mode)};
    LabOptions options;
    options.statistics.variance = true;  // no means, which would be forgotten first
    Lab ample = noisy_lab(lane_settings, options);
    run_to(ample, 20);
    // Room for somewhat more than what lies between the lanes, far less than for all.
    options.memory = ample.stored_bytes();
    run_to(ample, passes);
    Lab tight = noisy_lab(lane_settings, options);
    run_to(tight, passes);
    const std::uint64_t most = budget_pixels * (ahead + passes - 1);
    EXPECT_EQ(ample.store().traced(), most);
    EXPECT_TRUE(tight.store().partial());
    EXPECT_EQ(tight.store().traced(), most) << "none was traced again";
    EXPECT_LT(tight.store().stored(), most / 2);
    if (mode == SampleMode::unbiased) {
      EXPECT_TRUE(tight.pilot_store()->partial());
      EXPECT_EQ(tight.pilot_store()->traced(), most);
    }
    for (std::size_t i = 0; i < lane_settings.size(); ++i) {
      EXPECT_TRUE(std::ranges::equal(ample.lanes()[i].taken(), tight.lanes()[i].taken()));
      EXPECT_EQ(ample.lanes()[i].film().image(), tight.lanes()[i].film().image());
    }
  }
}

TEST(LabBudget, WithoutMemoryAPassTracesWhatItsLanesTakeAndNothingBetween) {
  constexpr std::uint32_t passes = 30;
  const std::vector<LaneSettings> lane_settings{one_a_pass(40, SampleMode::reuse),
                                                one_a_pass(1, SampleMode::reuse),
                                                one_a_pass(20, SampleMode::reuse)};
  const std::uint64_t least = budget_pixels * (40 + passes - 1);
  const std::uint64_t most = budget_pixels * (40 + 3 * (passes - 1));
  LabOptions options;
  options.statistics.variance = true;
  Lab ample = noisy_lab(lane_settings, options);
  run_to(ample, passes);
  options.memory = 1;
  Lab none = noisy_lab(lane_settings, options);
  run_to(none, passes);
  EXPECT_EQ(none.store().traced(), most);
  // Less, the more there is.
  std::uint64_t before = most;
  for (const std::size_t spp : {8, 16, 32}) {
    options.memory = budget_pixels * (40 + 14 * spp);
    Lab tight = noisy_lab(lane_settings, options);
    for (std::uint32_t pass = 1; pass <= passes; ++pass) {
      run_to(tight, pass);
      if (pass > 1) {
        EXPECT_LE(tight.stored_bytes(), options.memory) << pass;
      }
    }
    EXPECT_LT(tight.store().traced(), before);
    EXPECT_GT(tight.store().traced(), least);
    before = tight.store().traced();
    for (std::size_t i = 0; i < lane_settings.size(); ++i) {
      EXPECT_EQ(ample.lanes()[i].film().image(), tight.lanes()[i].film().image());
    }
  }
}

TEST(LabBudget, APilotIsTracedForTheLanesThatHaveOne) {
  constexpr std::uint32_t passes = 5;
  Lab lab = noisy_lab({one_a_pass(40, SampleMode::reuse), one_a_pass(2, SampleMode::unbiased)}, {});
  run_to(lab, passes);
  EXPECT_EQ(lab.store().traced(), budget_pixels * (40 + passes - 1));
  EXPECT_EQ(lab.pilot_store()->traced(), budget_pixels * (2 + passes - 1));
}

}  // namespace
}  // namespace quartet
