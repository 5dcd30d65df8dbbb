#include "renderer/adaptive/frame_history.h"

#include <gtest/gtest.h>

namespace quartet {
namespace {

TEST(FrameHistory, KeepsEveryFrameOfARunOfUsualLength) {
  FrameHistory history;
  for (std::uint32_t frame = 1; frame <= FrameHistory::most_records; ++frame) {
    history.push({.frame = frame});
    ASSERT_EQ(history.frames(), frame);
    ASSERT_EQ(history.records().size(), frame);
  }
}

TEST(FrameHistory, ALongRunIsThinnedEvenlyAndKeepsItsLastFrame) {
  FrameHistory history;
  for (std::uint32_t frame = 1; frame <= 100'000; ++frame) {
    history.push({.frame = frame, .samples = 3 * std::uint64_t(frame)});
    ASSERT_LE(history.records().size(), FrameHistory::most_records);
    ASSERT_EQ(history.records().back().frame, frame);
  }
  const auto records = history.records();
  EXPECT_GT(records.size(), FrameHistory::most_records / 2);
  const std::uint32_t stride = records[1].frame - records[0].frame;
  for (std::size_t i = 0; i + 1 < records.size(); ++i) {
    EXPECT_EQ(records[i].frame, stride * (i + 1));
    EXPECT_EQ(records[i].samples, 3 * std::uint64_t(records[i].frame));
  }
}

}  // namespace
}  // namespace quartet
