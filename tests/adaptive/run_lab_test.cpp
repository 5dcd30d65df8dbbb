#include "renderer/adaptive/run_lab.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "renderer/adaptive/lab.h"

namespace quartet {
namespace {

/// A lab of four grey pixels, each with one sample a pass.
Lab grey_lab(const std::function<void()>& before_samples = [] {}) {
  const SampleSource source = [before_samples](int, int, std::uint32_t,
                                               std::span<glm::vec3> radiance) {
    before_samples();
    std::ranges::fill(radiance, glm::vec3(0.5f));
  };
  const LaneSettings settings = default_settings(EstimatorId::uniform);
  LabOptions options;
  options.threads = 1;
  return {source, 2, 2, std::span(&settings, 1), options};
}

TEST(RunLab, AsksAfterEachPassWhetherThereShallBeAnother) {
  Lab lab = grey_lab();
  std::vector<std::uint32_t> asked;
  EXPECT_TRUE(run_lab(lab, {}, [&] {
    asked.push_back(lab.pass());
    return lab.pass() < 3;
  }));
  EXPECT_EQ(asked, (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_TRUE(run_lab(lab, {}, [] { return false; }));
  EXPECT_EQ(lab.pass(), 4u) << "at least one";
}

TEST(RunLab, BeginsNoPassOnceItShallStop) {
  Lab lab = grey_lab();
  std::stop_source stop;
  EXPECT_FALSE(run_lab(lab, stop.get_token(), [&] {
    stop.request_stop();
    return true;
  }));
  EXPECT_EQ(lab.pass(), 1u);
  bool asked = false;
  EXPECT_FALSE(run_lab(lab, stop.get_token(), [&] { return std::exchange(asked, true); }));
  EXPECT_EQ(lab.pass(), 1u);
  EXPECT_FALSE(asked);
  // Not even one that could be replayed.
  lab.rewind_past(0);
  EXPECT_FALSE(run_lab(lab, stop.get_token(), [] { return false; }));
  EXPECT_EQ(lab.pass(), 0u);
}

TEST(RunLab, AStopAfterTheLastPassComesTooLate) {
  Lab lab = grey_lab();
  std::stop_source stop;
  EXPECT_TRUE(run_lab(lab, stop.get_token(), [&] {
    stop.request_stop();
    return false;
  }));
}

TEST(RunLab, APassInWhichItShallStopIsNotLookedAt) {
  std::stop_source stop;
  Lab lab = grey_lab([&] { stop.request_stop(); });
  bool asked = false;
  EXPECT_FALSE(run_lab(lab, stop.get_token(), [&] { return std::exchange(asked, true); }));
  EXPECT_EQ(lab.pass(), 1u) << "the first samples of a store are never given up";
  EXPECT_FALSE(asked);
}

}  // namespace
}  // namespace quartet
