#include "app/window/window_size.h"

#include <gtest/gtest.h>

namespace quartet {
namespace {

TEST(WindowSize, IsAsWantedWhereThereIsRoom) {
  EXPECT_EQ(fitting_window({1600, 1000}, 1.0f, {1920, 1053}), (WindowSize{1600, 1000}));
  EXPECT_EQ(fitting_window({1600, 1000}, 2.0f, {3840, 2160}), (WindowSize{3200, 2000}));
}

TEST(WindowSize, IsNoLargerThanTheScreen) {
  EXPECT_EQ(fitting_window({1600, 1000}, 1.0f, {1366, 768}), (WindowSize{1366, 768}));
  EXPECT_EQ(fitting_window({1600, 1000}, 2.0f, {1366, 741}), (WindowSize{1366, 741}));
  EXPECT_EQ(fitting_window({16384, 700}, 1.0f, {1024, 768}), (WindowSize{1024, 700}));
  EXPECT_EQ(fitting_window({1600, 1000}, 1.0f, {320, 200}), (WindowSize{320, 200}));
}

TEST(WindowSize, IsAsWantedOnAScreenOfWhichNothingIsKnown) {
  EXPECT_EQ(fitting_window({1600, 1000}, 1.5f, {0, 0}), (WindowSize{2400, 1500}));
}

TEST(WindowSize, ThatIsRememberedComesBackAtAnyScale) {
  for (const float scale : {1.0f, 1.25f, 2.0f}) {
    const WindowSize seen = fitting_window({1280, 800}, scale, {4000, 3000});
    EXPECT_EQ(remembered_window(seen, scale), (WindowSize{1280, 800})) << scale;
  }
}

}  // namespace
}  // namespace quartet
