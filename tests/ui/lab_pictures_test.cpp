// The pictures of the window and how they are looked at: pan and zoom, the pixel under the mouse,
// layouts, views, the camera.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "renderer/scene/load_scene.h"
#include "renderer/view/reduce.h"
#include "renderer/view/views.h"
#include "tests/app/program.h"
#include "tests/ui/lab_hand.h"
#include "ui/widgets/pan_zoom.h"
#include "ui/window/pictures/pixel_text.h"

namespace quartet {
namespace {

TEST(LabPictures, WheelAndDragMoveAllPicturesTogether) {
  LabHand hand;
  const ScreenRect slot = hand.rect("lane1.slot0");
  const auto before = hand.pixels("lane3.slot0");
  hand.wheel(slot.center_x() + 30.0f, slot.center_y(), 3.0f);
  EXPECT_NEAR(hand.state().pan_zoom.zoom, std::pow(1.2f, 3.0f), 1e-3f);
  EXPECT_NE(hand.pixels("lane3.slot0"), before);
  const glm::vec2 center = hand.state().pan_zoom.center;
  hand.drag(slot.center_x(), slot.center_y(), slot.center_x() - 40.0f, slot.center_y() + 10.0f);
  EXPECT_GT(hand.state().pan_zoom.center.x, center.x);
  EXPECT_LT(hand.state().pan_zoom.center.y, center.y);
  EXPECT_FALSE(hand.state().pinned) << "a drag is no click";
  hand.key('f');
  EXPECT_EQ(hand.state().pan_zoom, PanZoom());
}

TEST(LabPictures, AClickPinsThePixelUnderTheMouse) {
  LabHand hand;
  const ScreenRect slot = hand.rect("lane2.slot0");
  const float x = slot.x + 0.25f * slot.width;
  const float y = slot.y + 0.5f * slot.height;
  hand.click(x, y);
  ASSERT_TRUE(hand.state().pinned);
  EXPECT_NEAR(hand.state().pinned->x, 24, 1);
  EXPECT_NEAR(hand.state().pinned->y, 27, 1);
  hand.move(-100.0f, -100.0f);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    EXPECT_TRUE(hand.has(lane_widget(lane, "slot0.read_out")));
  }
  hand.key(key_escape);
  EXPECT_FALSE(hand.state().pinned);
}

TEST(LabPictures, ARejectedSampleOfThePixelIsNamedAndCanBeTraced) {
  LabHand hand;
  const std::string scene = "synthetic:non-finite";
  set_scene(hand.state(), std::make_shared<const TraceScene>(open_scene(scene)));
  hand.state().request.store.settings.width = 48;
  hand.state().request.store.settings.height = 27;
  hand.settle();
  const LaneSnapshot& lane = hand.snapshot().lanes[1];
  ASSERT_FALSE(lane.rejected.empty());
  const auto at = std::ranges::find_if(lane.rejected, [](std::uint32_t n) { return n > 0; }) -
                  lane.rejected.begin();
  const glm::ivec2 pixel(int(at) % 48, int(at) / 48);
  EXPECT_FALSE(hand.driver().rejected());
  hand.state().pinned = pixel;
  hand.frame();
  const auto counted = hand.pixels("lane1.slot0.read_out");
  for (int i = 0; i < 2000 && !hand.driver().rejected(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    hand.frame();
  }
  hand.frames(2);
  const auto found = hand.driver().rejected();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->pixel, pixel);
  EXPECT_LT(found->index, lane.taken[std::size_t(at)]);
  EXPECT_NE(hand.pixels("lane1.slot0.read_out"), counted) << "the strip says which";
  const Result traced =
      run({"trace", scene, "--size", "48x27", "--pixel", fmt::format("{},{}", pixel.x, pixel.y),
           "--index", std::to_string(found->index)});
  EXPECT_EQ(traced.code, 0) << traced.error;
  EXPECT_NE(traced.out.find("rejected, no film takes it"), std::string::npos) << traced.out;
  // A pixel whose samples are all good has none.
  const auto good = std::ranges::find(lane.rejected, 0u) - lane.rejected.begin();
  hand.state().pinned = glm::ivec2(int(good) % 48, int(good) / 48);
  hand.frames(3);
  EXPECT_FALSE(hand.driver().rejected());
}

TEST(LabPictures, TheReadOutCountsRejectedSamplesAndNamesTheFirst) {
  PixelValues values;
  values.taken = 20;
  values.error_channels = 1;
  for (const Estimator& row : {estimator(EstimatorId::kl), estimator(EstimatorId::uniform)}) {
    values.rejected = 0;
    for (const std::string& text : read_out_texts(row, values, 7)) {
      EXPECT_EQ(text.find("reject"), std::string::npos) << text;
    }
    values.rejected = 2;
    for (const std::string& text : read_out_texts(row, values, std::nullopt)) {
      EXPECT_TRUE(text.ends_with(" · 2 rejected")) << text;
    }
    for (const std::string& text : read_out_texts(row, values, 7)) {
      EXPECT_NE(text.find(" · 2 rejected"), std::string::npos) << text;
      EXPECT_NE(text.find("index 7"), std::string::npos) << text;
    }
    for (const std::string& text : read_out_texts(row, values, 20)) {
      EXPECT_TRUE(text.ends_with(" · 2 rejected")) << "sample 20 was not taken: " << text;
    }
  }
}

TEST(LabPictures, TheReadOutSaysWhetherThePixelIsDone) {
  PixelValues values;
  values.taken = 20;
  values.error_channels = 1;
  values.error[0] = 3.0f;
  values.scaled_error = 1.5f;
  for (const PixelState state : {PixelState::done, PixelState::refining, PixelState::at_maximum}) {
    values.state = state;
    const std::string label(pixel_state_label(state));
    EXPECT_EQ(
        read_out_texts(estimator(EstimatorId::kl), values, std::nullopt),
        (std::vector<std::string>{"20 spp · " + label + " · error 3.00 = 1.50 × threshold",
                                  "20 spp · " + label + " · error 3.00 (1.50×)",
                                  "20 spp · " + label + " · error 1.50×", "20 spp · error 1.50×"}));
    EXPECT_EQ(read_out_texts(estimator(EstimatorId::uniform), values, std::nullopt).front(),
              "20 spp · " + label);
  }
}

TEST(LabPictures, LayoutsShowTheirLanes) {
  LabHand hand;
  hand.key('l');
  EXPECT_EQ(hand.state().layout, LabLayout::grid);
  EXPECT_GT(hand.rect("lane2.slot0").y, hand.rect("lane0.slot0").bottom());
  hand.key('l');
  EXPECT_EQ(hand.state().layout, LabLayout::large);
  hand.key('3');
  EXPECT_TRUE(hand.has("lane2.slot0"));
  EXPECT_FALSE(hand.has("lane0.slot0"));
  EXPECT_GT(hand.rect("lane2.slot0").width, 1000.0f);
  hand.settle();
  const auto a = hand.pixels("lane2.slot0");
  hand.key('w');
  hand.frames(3);
  EXPECT_NE(hand.pixels("lane2.slot0"), a);
  const float at = hand.state().comparison.wipe_at;
  hand.drag("wipe", -120.0f);
  // The read-out says the numbers of both lanes: one line in the colour of each.
  const ScreenRect slot = hand.rect("lane2.slot0");
  hand.move(slot.x + 0.3f * slot.width, slot.center_y());
  const auto strip = hand.pixels("lane2.slot0.read_out");
  // Smooth edges leave few pixels of just that colour: nearer to it than to anything else will do.
  const std::array shown{hand.state().comparison.lane, hand.state().comparison.other};
  const auto color_of = [&](std::size_t lane) {
    return estimator_color(hand.state().request.lanes.settings[lane].estimator);
  };
  const std::array<ImU32, 4> colors{color_of(shown[0]), color_of(shown[1]), palette::text,
                                    IM_COL32_BLACK};
  std::array<int, 4> nearest{};
  for (const Rgba8 pixel : strip) {
    const auto distance = [&](ImU32 color) {
      const glm::vec3 from(pixel.r, pixel.g, pixel.b);
      return glm::distance(from, glm::vec3(color & 255u, color >> 8 & 255u, color >> 16 & 255u));
    };
    ++nearest[std::size_t(std::ranges::min_element(colors, {}, distance) - colors.begin())];
  }
  for (std::size_t i = 0; i < shown.size(); ++i) {
    EXPECT_GT(nearest[i], 20) << "lane " << shown[i] + 1;
  }
  hand.move(-100.0f, -100.0f);
  EXPECT_LT(hand.state().comparison.wipe_at, at);
  const Comparison unflipped = hand.state().comparison;
  EXPECT_EQ(unflipped.lane, 2u);
  hand.key('a');
  EXPECT_EQ(hand.state().comparison.lane, unflipped.other);
  EXPECT_EQ(hand.state().comparison.other, 2u);
  hand.choose("layout", "columns");
  hand.key(key_escape);
}

/// What a screen shows of a view that is larger than its slot.
void expect_reduced(LabHand& hand, const std::string& slot, const DisplayImage& view, float from_x,
                    float to_x) {
  const ScreenRect box = hand.rect(slot);
  const PicturePlace place = place_picture(hand.state().pan_zoom, box, view.width(), view.height());
  ASSERT_LT(place.scale, 1.0f);
  const glm::ivec2 corner(glm::round(glm::vec2(place.x, place.y)));
  const glm::ivec2 size(glm::round(place.scale * glm::vec2(view.width(), view.height())));
  const DisplayImage small = reduce(view, size.x, size.y);
  const DisplayImage screen = hand.screen();
  const int left = std::max(int(from_x), corner.x);
  const int right = std::min(int(to_x), corner.x + size.x);
  int compared = 0;
  // Below the controls, which lie on the picture.
  for (int y = std::max(int(box.y) + 70, corner.y);
       y < std::min(int(box.bottom()), corner.y + size.y); ++y) {
    for (int x = left; x < right; ++x) {
      ASSERT_EQ(screen.at(x, y), small.at(x - corner.x, y - corner.y))
          << slot << " " << x << "," << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 10000);
}

TEST(LabPictures, OneLargerThanItsSlotIsAveraged) {
  LabHand hand;
  hand.state().request.store.settings.width = 640;
  hand.state().request.store.settings.height = 360;
  hand.state().playback.set_target(2);
  hand.settle();
  const auto view = [&](std::size_t lane) {
    return draw_view(hand.snapshot(), lane, ViewKind::image, hand.state().view).image;
  };
  const ScreenRect column = hand.rect("lane1.slot0");
  expect_reduced(hand, "lane1.slot0", view(1), column.x + 4.0f, column.right() - 4.0f);

  // Either side of the line between two lanes, whose pictures differ.
  hand.key('l');
  hand.key('l');
  hand.key('1');
  hand.key('w');
  hand.state().pan_zoom.zoom = 0.4f;
  hand.move(-100.0f, -100.0f);
  hand.settle();
  const Comparison& comparison = hand.state().comparison;
  ASSERT_NE(view(comparison.lane), view(comparison.other));
  const ScreenRect slot = hand.rect("lane0.slot0");
  const float line = slot.x + comparison.wipe_at * slot.width;
  expect_reduced(hand, "lane0.slot0", view(comparison.lane), slot.x + 4.0f, line - 4.0f);
  expect_reduced(hand, "lane0.slot0", view(comparison.other), line + 4.0f, slot.right() - 4.0f);
}

TEST(LabPictures, HoldingAKeyShowsTheFirstLaneEverywhere) {
  LabHand hand;
  const auto before = heatmaps(hand);
  ASSERT_NE(before[3], before[0]);
  hand.window().key({'c', true, false, false});
  hand.frames(3);
  EXPECT_NE(heatmaps(hand)[3], before[3]);
  hand.window().key({'c', false, false, false});
  hand.frames(3);
  EXPECT_EQ(heatmaps(hand)[3], before[3]);
}

TEST(LabPictures, CameraTurnsAndComesHome) {
  LabHand hand;
  const Camera home = hand.state().request.store.settings.camera;
  const ScreenRect slot = hand.rect("lane0.slot0");
  hand.drag(slot.center_x(), slot.center_y(), slot.center_x() + 20.0f, slot.center_y(), 1);
  hand.settle();
  const Camera& turned = hand.state().request.store.settings.camera;
  EXPECT_NE(turned, home);
  EXPECT_NEAR(glm::length(turned.forward), 1.0f, 1e-5f);
  EXPECT_NEAR(glm::dot(turned.forward, turned.right), 0.0f, 1e-5f);
  EXPECT_NEAR(glm::distance(turned.origin, hand.state().camera.pivot),
              glm::distance(home.origin, hand.state().camera.pivot), 0.01f);
  EXPECT_EQ(hand.snapshot().settings.camera, turned);
  hand.key(key_page_up);
  EXPECT_LT(
      glm::distance(hand.state().request.store.settings.camera.origin, hand.state().camera.pivot),
      glm::distance(home.origin, hand.state().camera.pivot));
  hand.key(key_home);
  hand.settle();
  EXPECT_EQ(hand.state().request.store.settings.camera, home);
}

TEST(LabPictures, EveryViewHasSomethingToShow) {
  LabHand hand;
  for (const ViewRow& row : views()) {
    if (row.needs.other_lane) {
      continue;
    }
    hand.choose("lane1.slot1.view", std::string(row.id));
    hand.move(-100.0f, -100.0f);
    hand.settle();
    EXPECT_EQ(hand.state().slots[1][1].kind, row.key);
    EXPECT_EQ(hand.state().request.lanes.variance, row.key == ViewKind::variance);
  }
  hand.choose("lane1.slot1.view", "difference0");
  EXPECT_EQ(hand.state().slots[1][1], (SlotChoice{ViewKind::difference, 0}));
}

}  // namespace
}  // namespace quartet
