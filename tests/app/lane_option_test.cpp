#include "app/options/lane_option.h"

#include <gtest/gtest.h>

#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

TEST(LaneOption, ALaneAsOneWordIsReadBackExactly) {
  for (const Estimator& row : estimators()) {
    for (const PolicyRow& kind : policies()) {
      LaneSettings settings = default_settings(row.key);
      for (int c = 0; c < row.channels; ++c) {
        settings.thresholds[std::size_t(c)] *= 1.0f / 3.0f;
      }
      settings.max_spp = 77;
      settings.mode = SampleMode::unbiased;
      LaneSettings all = settings;
      all.policy = {kind.key, 4, 12, 0.1f, true};
      // What is not read is not in the word, and comes back as it is by default.
      if (row.channels > 0) {
        settings.policy.kind = kind.key;
      }
      for (const PolicyParameter& parameter : policy_parameters()) {
        if (reads(settings, parameter.key)) {
          copy_parameter(parameter, all.policy, settings.policy);
        }
      }
      LaneSettings read = parse_lane(lane_text(all), {});
      for (int c = row.channels; c < 3; ++c) {
        read.thresholds[std::size_t(c)] = settings.thresholds[std::size_t(c)];
      }
      EXPECT_EQ(read, settings) << lane_text(all);
    }
  }
}

TEST(LaneOption, ALaneAsItComesIsOneWordOfItsThresholds) {
  for (const Estimator& row : estimators()) {
    const LaneSettings settings = default_settings(row.key);
    EXPECT_EQ(parse_lane(std::string(row.id), {}), settings);
    EXPECT_EQ(lane_text(settings).find("policy="), std::string::npos);
  }
}

TEST(LaneOption, SaysWhatIsWrong) {
  for (const char* text : {"kl:", "kl:x", "kl:0", "kl:-1", "kl:nan", "kl:1,2", "contrast:1,2",
                           "kl:multiplier=", "uniform:1", "kl:max-spp=many", "kl:speed=3",
                           "kl:first=70000", "kl:batch=-1"}) {
    EXPECT_NE(error_of([&] { parse_lane(text, {}); }).find("--lane"), std::string::npos) << text;
  }
  EXPECT_NE(error_of([] { parse_lane("best:1", {}); }).find("there are: contrast"),
            std::string::npos);
}

}  // namespace
}  // namespace quartet
