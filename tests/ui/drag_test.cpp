// Which way things go when the mouse does: every drag and the wheel, by sign.

#include <gtest/gtest.h>

#include "tests/ui/lab_hand.h"

namespace quartet {
namespace {

using Number = double (*)(LabHand& hand);

/// A widget, dragged by so many pixels to the right, and a number that must follow.
struct DraggedWidget {
  const char* widget;
  float by;
  Number number;
  int sign;  ///< of its change
};

template <std::size_t lane>
double threshold(LabHand& hand) {
  return double(hand.settings(lane).thresholds[0]);
}
double multiplier(LabHand& hand) {
  return double(hand.settings(2).policy.multiplier);
}
double exposure(LabHand& hand) {
  return double(hand.state().view.exposure);
}
double pass(LabHand& hand) {
  return hand.state().playback.wanted();
}
double seed(LabHand& hand) {
  return double(hand.state().request.store.settings.seed);
}
double wipe(LabHand& hand) {
  return double(hand.state().comparison.wipe_at);
}
double dock(LabHand& hand) {
  return double(hand.rect("dock.box").height);
}

// A press beside a knob takes it there, and one soon after at the same place is a double click: so
// all to the right first, then all to the left.
constexpr DraggedWidget dragged_widgets[] = {
    {"lane1.threshold0", 20, threshold<1>, 1},
    {"lane1.threshold0.number", 30, threshold<1>, 1},
    {"lane3.errors.marker0", 15, threshold<3>, 1},
    {"lane2.multiplier", 15, multiplier, 1},
    {"lane2.multiplier.number", 15, multiplier, 1},
    {"exposure", 15, exposure, 1},
    {"exposure.number", 15, exposure, 1},
    {"seed", 60, seed, 1},
    {"pass", -20, pass, -1},
    {"lane1.threshold0", -20, threshold<1>, -1},
    {"lane1.threshold0.number", -30, threshold<1>, -1},
    {"lane3.errors.marker0", -15, threshold<3>, -1},
    {"lane2.multiplier", -30, multiplier, -1},
    {"exposure", -15, exposure, -1},
    {"pass", 20, pass, 1},
};

TEST(Drag, NumbersFollowTheMouse) {
  LabHand hand(1280, 720);
  for (const DraggedWidget& each : dragged_widgets) {
    SCOPED_TRACE(std::string(each.widget) + " by " + std::to_string(int(each.by)));
    const ScreenRect box = hand.rect(each.widget);
    const double before = each.number(hand);
    hand.move(box.center_x(), box.center_y());
    hand.press(true);
    hand.move(box.center_x() + 0.5f * each.by, box.center_y());
    hand.move(box.center_x() + each.by, box.center_y());
    hand.press(false);
    EXPECT_GT((each.number(hand) - before) * each.sign, 0.0) << "from " << before;
  }
}

TEST(Drag, ASeedStopsAtZero) {
  LabHand hand(1280, 720);
  hand.drag("seed", -200.0f);
  EXPECT_EQ(hand.state().request.store.settings.seed, 0u);
}

TEST(Drag, TheWipeFollowsTheMouse) {
  LabHand hand(1280, 720);
  hand.state().layout = LabLayout::large;
  hand.state().comparison.wipe = true;
  hand.frames(3);
  const double before = wipe(hand);
  hand.drag("wipe", 60.0f);
  const double right = wipe(hand);
  EXPECT_GT(right, before);
  hand.drag("wipe", -90.0f);
  EXPECT_LT(wipe(hand), before);
}

TEST(Drag, TheDocksEdgeFollowsTheMouse) {
  LabHand hand;
  hand.key('d');
  const double before = dock(hand);
  const auto pull = [&](float by) {
    const ScreenRect edge = hand.rect("dock.edge");
    hand.drag(edge.center_x(), edge.center_y(), edge.center_x(), edge.center_y() + by);
  };
  pull(-50.0f);
  EXPECT_NEAR(dock(hand), before + 50.0, 3.0);
  pull(80.0f);
  EXPECT_NEAR(dock(hand), before - 30.0, 3.0);
  pull(2000.0f);
  const double least = dock(hand);
  pull(-20.0f);
  EXPECT_GT(dock(hand), least) << "from the end of its way it comes back";
}

/// How far the camera goes to its right and upwards.
template <class Action>
glm::vec2 way_of_camera(LabHand& hand, const Action& action) {
  const Camera before = hand.state().request.store.settings.camera;
  action();
  const glm::vec3 way = hand.state().request.store.settings.camera.origin - before.origin;
  hand.state().request.store.settings.camera = before;
  return {glm::dot(way, before.right), glm::dot(way, before.up)};
}

TEST(Drag, ARightDragTakesTheCameraToTheRightAndADragDownTakesItUp) {
  LabHand hand(1280, 720);
  const ScreenRect slot = hand.rect("lane0.slot0");
  const auto turned = [&](float x, float y) {
    return way_of_camera(hand, [&] {
      hand.move(slot.center_x(), slot.center_y());
      hand.press(true, 1);
      hand.move(slot.center_x() + x, slot.center_y() + y);
      hand.press(false, 1);
    });
  };
  EXPECT_GT(turned(20.0f, 0.0f).x, 0.0f);
  EXPECT_LT(turned(-20.0f, 0.0f).x, 0.0f);
  EXPECT_GT(turned(0.0f, 20.0f).y, 0.0f);
  EXPECT_LT(turned(0.0f, -20.0f).y, 0.0f);
}

TEST(Drag, ArrowsTurnTheCamera) {
  LabHand hand(1280, 720);
  const auto turned = [&](int key) {
    return way_of_camera(hand, [&] { hand.window().key({key, true, false, false}); });
  };
  EXPECT_LT(turned(key_right).x, 0.0f) << "its view turns to the right";
  EXPECT_GT(turned(key_left).x, 0.0f);
  EXPECT_GT(turned(key_up).y, 0.0f);
  EXPECT_LT(turned(key_down).y, 0.0f);
}

TEST(Drag, TheWheelZoomsAndWithCtrlBringsTheCameraNearer) {
  LabHand hand(1280, 720);
  const ScreenRect slot = hand.rect("lane0.slot0");
  const auto distance = [&] {
    return glm::distance(hand.state().request.store.settings.camera.origin,
                         hand.state().camera.pivot);
  };
  const float before = distance();
  hand.wheel(slot.center_x(), slot.center_y(), 2.0f);
  EXPECT_GT(hand.state().pan_zoom.zoom, 1.0f);
  EXPECT_EQ(distance(), before);
  hand.wheel(slot.center_x(), slot.center_y(), -4.0f);
  EXPECT_LT(hand.state().pan_zoom.zoom, 1.0f);
  const float zoom = hand.state().pan_zoom.zoom;
  add_ctrl_key(true);
  hand.wheel(slot.center_x(), slot.center_y(), 1.0f);
  EXPECT_LT(distance(), before);
  hand.wheel(slot.center_x(), slot.center_y(), -2.0f);
  EXPECT_GT(distance(), before);
  add_ctrl_key(false);
  EXPECT_EQ(hand.state().pan_zoom.zoom, zoom);
  hand.key(key_home);
  hand.key(key_page_up);
  EXPECT_LT(distance(), before);
  hand.key(key_home);
  hand.key(key_page_down);
  EXPECT_GT(distance(), before);
}

/// Pressed at the middle of a picture, let go so many pixels to the right.
void press_and_move(LabHand& hand, float by) {
  const ScreenRect slot = hand.rect("lane0.slot0");
  hand.move(slot.center_x(), slot.center_y());
  hand.press(true);
  hand.move(slot.center_x() + by, slot.center_y());
  hand.press(false);
}

TEST(Drag, UnderThreePixelsItIsAClickThatPins) {
  LabHand hand(1280, 720);
  press_and_move(hand, 2.0f);
  EXPECT_TRUE(hand.state().pinned);
  EXPECT_EQ(hand.state().pan_zoom, PanZoom());
}

TEST(Drag, FromThreePixelsOnItPansAndPinsNothing) {
  LabHand hand(1280, 720);
  press_and_move(hand, 3.0f);
  EXPECT_FALSE(hand.state().pinned);
  EXPECT_LT(hand.state().pan_zoom.center.x, 0.5f) << "the picture follows the mouse";
}

TEST(Drag, APictureFollowsTheMouse) {
  LabHand hand(1280, 720);
  const ScreenRect slot = hand.rect("lane0.slot0");
  const auto center = [&](float x, float y) {
    hand.state().pan_zoom = {};
    hand.drag(slot.center_x(), slot.center_y(), slot.center_x() + x, slot.center_y() + y);
    return hand.state().pan_zoom.center;
  };
  EXPECT_LT(center(30.0f, 0.0f).x, 0.5f);
  EXPECT_GT(center(-30.0f, 0.0f).x, 0.5f);
  EXPECT_LT(center(0.0f, 20.0f).y, 0.5f);
  EXPECT_GT(center(0.0f, -20.0f).y, 0.5f);
}

}  // namespace
}  // namespace quartet
