#include "renderer/adaptive/frame_history.h"

#include <gtest/gtest.h>

namespace quartet {
namespace {

TEST(FrameHistory, KeepsEveryFrameOfARunOfUsualLength) {
  FrameHistory history;
  for (std::uint32_t frame = 1; frame <= FrameHistory::most_records; ++frame) {
    history.push({.frame = frame}, {});
    ASSERT_EQ(history.frames(), frame);
    ASSERT_EQ(history.records().size(), frame);
  }
}

TEST(FrameHistory, ALongRunIsThinnedEvenlyAndKeepsItsLastFrame) {
  FrameHistory history;
  for (std::uint32_t frame = 1; frame <= 100'000; ++frame) {
    SampleCosts::Work work;
    work.units[5] = 10 * std::uint64_t(frame);
    history.push({.frame = frame,
                  .samples = 3 * std::uint64_t(frame),
                  .seconds = 0.25 * frame,
                  .true_error = 1.0 / frame},
                 work);
    ASSERT_LE(history.records().size(), FrameHistory::most_records);
    ASSERT_EQ(history.records().back().frame, frame);
  }
  SampleCosts costs;
  costs.add(5, 20, 10.0);
  history.charge(costs, false);
  const auto records = history.records();
  EXPECT_GT(records.size(), FrameHistory::most_records / 2);
  const std::uint32_t stride = records[1].frame - records[0].frame;
  for (std::size_t i = 0; i + 1 < records.size(); ++i) {
    EXPECT_EQ(records[i].frame, stride * (i + 1));
    EXPECT_EQ(records[i].samples, 3 * std::uint64_t(records[i].frame));
    EXPECT_EQ(records[i].true_error, 1.0 / records[i].frame);
    EXPECT_EQ(records[i].tracing_seconds, 5.0 * records[i].frame);
    EXPECT_EQ(records[i].seconds, 5.25 * records[i].frame);
  }
}

TEST(FrameHistory, AllRecordsAreChargedByTheNewestCosts) {
  FrameHistory history;
  SampleCosts costs;
  costs.add(0, 1, 1.0);
  SampleCosts::Work work;
  for (std::uint32_t frame = 1; frame <= 3; ++frame) {
    work.units[0] += 4;
    history.push({.frame = frame, .seconds = 0.5}, work);
    history.charge(costs, true);
    EXPECT_EQ(history.back().seconds, 4.0 * frame + 0.5);
  }
  costs.add(0, 1, 2.0);
  history.charge(costs, false);
  EXPECT_EQ(history.records()[0].seconds, 6.5);
  EXPECT_EQ(history.records()[2].seconds, 18.5);
  EXPECT_EQ(history.records()[2].tracing_seconds, 18.0);
}

}  // namespace
}  // namespace quartet
