#include "ui/widgets/pan_zoom.h"

#include <gtest/gtest.h>

namespace quartet {
namespace {

constexpr ScreenRect slot{100, 50, 400, 300};
constexpr int width = 160;
constexpr int height = 90;

TEST(PanZoom, FitsTheWholePicture) {
  const PicturePlace place = place_picture({}, slot, width, height);
  EXPECT_FLOAT_EQ(place.scale, 2.5f);
  EXPECT_FLOAT_EQ(place.x, 100.0f);
  EXPECT_FLOAT_EQ(place.y, 50.0f + (300.0f - 225.0f) / 2);
  EXPECT_EQ(place.pixel_at(100.5f, 88.0f, width, height), glm::ivec2(0, 0));
  EXPECT_EQ(place.pixel_at(499.5f, 312.0f, width, height), glm::ivec2(159, 89));
  EXPECT_FALSE(place.pixel_at(300.0f, 60.0f, width, height)) << "above the picture";
}

TEST(PanZoom, ThePointUnderTheMouseStays) {
  PanZoom view;
  const auto before = place_picture(view, slot, width, height).pixel_at(381, 171, width, height);
  for (int i = 0; i < 12; ++i) {
    view = zoomed_at(view, slot, width, height, 381, 171, 1.2f);
    EXPECT_EQ(place_picture(view, slot, width, height).pixel_at(381, 171, width, height), before);
  }
}

TEST(PanZoom, StaysWithinReason) {
  PanZoom view = zoomed_at({}, slot, width, height, 300, 200, 1e9f);
  EXPECT_LE(view.zoom, 40.0f);
  view = panned(view, slot, width, height, 1e9f, -1e9f);
  EXPECT_EQ(view.center, glm::vec2(0.0f, 1.0f));
  EXPECT_GE(zoomed_at({}, slot, width, height, 300, 200, 1e-9f).zoom, 0.25f);
}

TEST(PanZoom, ASlotWithoutRoomChangesNothing) {
  for (const ScreenRect& none : {ScreenRect{100, 50, 0, 300}, {100, 50, 400, 0}, {0, 0, 0, 0}}) {
    const PanZoom view{3.0f, {0.2f, 0.7f}};
    EXPECT_EQ(zoomed_at(view, none, width, height, 100, 50, 1.2f), view);
    EXPECT_EQ(panned(view, none, width, height, 5, 5), view);
    EXPECT_FALSE(place_picture(view, none, width, height).pixel_at(100, 50, width, height));
  }
}

TEST(PanZoom, APictureOfAFewPixelsStillFits) {
  for (const int side : {1, 2, 3}) {
    const PanZoom view = zoomed_at({}, slot, side, side, 300, 200, 1e9f);
    EXPECT_GE(view.zoom, 1.0f) << side;
    EXPECT_FALSE(place_picture(view, slot, side, side).pixel_at(-1e9f, 1e9f, side, side));
  }
}

}  // namespace
}  // namespace quartet
