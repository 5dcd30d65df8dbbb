// The window, used as a hand would use it: mouse and keys in, state and pixels out.

#include "ui/window/lab_window.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "renderer/adaptive/memory_need.h"
#include "renderer/scene/synthetic.h"
#include "tests/files/temp_folder.h"
#include "tests/ui/lab_hand.h"
#include "ui/window/lab_layout.h"
#include "ui/window/lane_header.h"

namespace quartet {
namespace {

/// Only one lane's thing changed.
template <class Things>
void expect_only(std::size_t changed, const Things& before, const Things& after) {
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    EXPECT_EQ(before[lane] != after[lane], lane == changed) << "lane " << lane + 1;
  }
}

TEST(LabWindow, DraggingAThresholdLineReplaysItsLaneAlone) {
  LabHand hand;
  // Each on a scale of its own, because the highest count of one lane is the end of all their
  // scales otherwise.
  hand.state().view.heat = HeatRange::report;
  hand.settle();
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const auto before = heatmaps(hand);
    const auto lane_settings = hand.state().request.lanes.settings;
    const std::uint64_t not_done = hand.snapshot().lanes[lane].history.back().not_done;
    hand.drag(lane_widget(lane, "errors.marker0"), -45.0f);
    hand.move(-100.0f, -100.0f);
    hand.settle();
    expect_only(lane, lane_settings, hand.state().request.lanes.settings);
    EXPECT_LT(hand.settings(lane).thresholds[0], lane_settings[lane].thresholds[0]);
    EXPECT_EQ(hand.snapshot().lanes[lane].settings, hand.settings(lane));
    EXPECT_GT(hand.snapshot().lanes[lane].history.back().not_done, not_done);
    expect_only(lane, before, heatmaps(hand));
  }
}

TEST(LabWindow, TheAxisOfErrorsStandsStillUnderADrag) {
  LabHand hand;
  const ScreenRect plot = hand.rect("lane1.errors");
  const ScreenRect marker = hand.rect("lane1.errors.marker0");
  hand.move(marker.center_x(), plot.center_y());
  hand.press(true);
  EXPECT_EQ(hand.window().ui().held, "lane1.errors");
  const auto threshold_at = [&](float x) {
    add_mouse_position(x, plot.center_y());
    hand.frames(2);
    return hand.settings(1).thresholds[0];
  };
  // Far to the left nearly no pixel is done and the errors shrink; then back.
  const float start = threshold_at(marker.center_x() + 6.0f);
  const float low = threshold_at(plot.x + 2.0f);
  hand.settle();
  EXPECT_LT(low, 0.1f * start);
  EXPECT_EQ(threshold_at(plot.x + 2.0f), low);
  EXPECT_EQ(threshold_at(marker.center_x() + 6.0f), start);
  ASSERT_TRUE(hand.state().held_axis);
  EXPECT_EQ(hand.state().held_axis->lane, 1u);
  hand.press(false);
  hand.frames(2);
  EXPECT_FALSE(hand.state().held_axis);
}

TEST(LabWindow, TheAxisOfErrorsFollowsASliderOutwardsAndComesBackAtItsEnd) {
  LabHand hand;
  const ScreenRect slider = hand.rect("lane2.threshold0");
  const DecadeRange usual = error_decades(hand.snapshot().lanes[2], hand.settings(2).thresholds);
  hand.move(slider.center_x(), slider.center_y());
  hand.press(true);
  const auto pull = [&](float x) {
    add_mouse_position(x, slider.center_y());
    hand.settle();
    return hand.state().held_axis ? hand.state().held_axis->decades : DecadeRange{};
  };
  const DecadeRange wide = pull(slider.right() - 8.0f);
  EXPECT_LE(wide.first, usual.first);
  EXPECT_GE(wide.last, usual.last);
  EXPECT_GT(std::pow(10.0, wide.last), double(hand.settings(2).thresholds[0]));
  const DecadeRange back = pull(slider.center_x());
  EXPECT_EQ(back.with(wide), back) << "it shrinks only once the mouse lets go";
  hand.press(false);
  hand.frames(2);
  EXPECT_FALSE(hand.state().held_axis);
}

TEST(LabWindow, EveryThresholdOfContrastHasItsLineAndSlider) {
  LabHand hand;
  for (int channel = 0; channel < 3; ++channel) {
    const Thresholds before = hand.settings(0).thresholds;
    hand.drag("lane0.errors.marker" + std::to_string(channel), 12.0f);
    hand.drag("lane0.threshold" + std::to_string(channel), -15.0f);
    for (int other = 0; other < 3; ++other) {
      const auto c = std::size_t(other);
      EXPECT_EQ(before[c] != hand.settings(0).thresholds[c], other == channel);
    }
  }
  hand.click("lane0.reset");
  EXPECT_EQ(hand.settings(0).thresholds, default_settings(EstimatorId::contrast).thresholds);
}

TEST(LabWindow, SlidersMoveWhatTheySay) {
  LabHand hand;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const auto before = hand.state().request.lanes.settings;
    hand.drag(lane_widget(lane, "multiplier"), 40.0f);
    const auto moved = hand.state().request.lanes.settings;
    expect_only(lane, before, moved);
    EXPECT_NE(moved[lane].policy.multiplier, before[lane].policy.multiplier);
    const std::string slider = lane_widget(lane, "threshold0");
    hand.drag(slider, 25.0f);
    expect_only(lane, moved, hand.state().request.lanes.settings);
    // At either end the slider gives the end of its range.
    const ScreenRect box = hand.rect(slider);
    const ThresholdRange range = threshold_range(estimator(hand.settings(lane).estimator), 0);
    hand.drag(box.center_x(), box.center_y(), box.x - 50.0f, box.center_y());
    EXPECT_FLOAT_EQ(hand.settings(lane).thresholds[0], range.low);
    hand.click(lane_widget(lane, "reset"));
  }
  hand.drag("exposure", 20.0f);
  EXPECT_NE(hand.state().view.exposure, 0.0f);
}

TEST(LabWindow, EstimatorComboGivesTheLaneAnother) {
  LabHand hand;
  hand.state().view.heat = HeatRange::report;
  hand.settle();
  const auto before = heatmaps(hand);
  hand.choose("lane2.estimator", "uniform");
  hand.move(-100.0f, -100.0f);
  hand.settle();
  EXPECT_EQ(hand.settings(2).estimator, EstimatorId::uniform);
  EXPECT_EQ(hand.snapshot().lanes[2].settings.estimator, EstimatorId::uniform);
  expect_only(2, before, heatmaps(hand));
  EXPECT_FALSE(hand.has("lane2.threshold0")) << "uniform has no threshold";
  hand.choose("lane2.estimator", "kl");
  hand.settle();
  EXPECT_EQ(hand.settings(2), default_settings(EstimatorId::kl));
  // The same settings give the same lane.
  EXPECT_EQ(hand.snapshot().lanes[2].taken, hand.snapshot().lanes[1].taken);
}

TEST(LabWindow, EveryEstimatorOfTheTableCanBeChosenAndBringsItsPolicy) {
  LabHand hand;
  hand.state().request.store.settings.width = 32;
  hand.state().request.store.settings.height = 18;
  hand.settle();
  for (const Estimator& row : estimators()) {
    SCOPED_TRACE(row.id);
    const std::string id(row.id);
    if (row.needs_reference) {
      hand.click("lane2.estimator");
      hand.frames(3);
      EXPECT_FALSE(hand.has("lane2.estimator." + id)) << "there is nothing to compare with";
      hand.click("lane2.estimator.uniform");
      continue;
    }
    hand.choose("lane2.estimator", id);
    hand.settle();
    EXPECT_EQ(hand.settings(2), default_settings(row.key));
    EXPECT_EQ(hand.snapshot().lanes[2].settings, hand.settings(2));
    EXPECT_EQ(hand.snapshot().lanes[2].error.size(),
              std::size_t(row.channels) * hand.snapshot().pixels());
  }
  // A policy that was chosen stays.
  hand.choose("lane2.policy", "two-level");
  hand.choose("lane2.estimator", "cycles");
  EXPECT_EQ(hand.settings(2).policy.kind, PolicyId::two_level);
}

TEST(LabWindow, TheModeComboMakesALaneUnbiased) {
  LabHand hand;
  hand.settle();
  const Snapshot before = hand.snapshot();
  hand.choose("lane1.mode", "unbiased");
  hand.settle();
  EXPECT_EQ(hand.settings(1).mode, SampleMode::unbiased);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const LaneSnapshot& now = hand.snapshot().lanes[lane];
    EXPECT_EQ(now.mean != before.lanes[lane].mean, lane == 1) << lane;
    EXPECT_EQ(now.history.back().pilot_samples > 0, lane == 1) << lane;
  }
  hand.choose("lane1.mode", "reuse");
  hand.settle();
  EXPECT_EQ(hand.snapshot().lanes[1].mean, before.lanes[1].mean);
}

TEST(LabWindow, PassesAreScrubbedSteppedAndPlayed) {
  LabHand hand;
  ASSERT_EQ(hand.snapshot().pass, 5u);
  const std::vector<std::uint32_t> last = hand.snapshot().lanes[1].taken;
  const ScreenRect slider = hand.rect("pass");
  hand.drag(slider.right() - 7.0f, slider.center_y(), slider.x + 3.0f, slider.center_y());
  hand.settle();
  EXPECT_EQ(hand.snapshot().pass, 1u);
  hand.click("forward");
  hand.settle();
  EXPECT_EQ(hand.snapshot().pass, 2u);
  hand.key('.');
  hand.settle();
  EXPECT_EQ(hand.snapshot().pass, 3u);
  hand.key(',');
  hand.settle();
  EXPECT_EQ(hand.snapshot().pass, 2u);
  EXPECT_FALSE(hand.state().playback.playing());
  hand.key(' ');
  for (int i = 0; i < 2000 && hand.snapshot().pass < 5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    hand.frame();
  }
  EXPECT_EQ(hand.snapshot().pass, 5u);
  EXPECT_EQ(hand.snapshot().lanes[1].taken, last) << "a replay ends where the first run did";
}

TEST(LabWindow, ABrokenSceneIsNamedAndTheOldOneStays) {
  const TempFolder folder;
  const std::filesystem::path broken = folder / "broken.xml";
  std::ofstream(broken) << "<scene version=\"3.0.0\">\n  <shape type=\"rectangle\">\n</scene>\n";
  LabHand hand;
  const auto scene = hand.state().request.store.scene;
  hand.click("scene");
  hand.frames(3);
  hand.click("scene.path");
  hand.type(broken.string());
  for (int i = 0; i < 2000 && hand.window().message().kind == Message::Kind::none; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    hand.frame();
  }
  ASSERT_EQ(hand.window().message().kind, Message::Kind::error);
  EXPECT_NE(hand.window().message().text.find("broken.xml:"), std::string::npos)
      << hand.window().message().text;
  EXPECT_EQ(hand.state().request.store.scene, scene);
  EXPECT_EQ(hand.snapshot().pass, 5u);
  hand.click("message");
  EXPECT_EQ(hand.window().message().kind, Message::Kind::none);
}

/// Frames until there is a message.
void wait_for_message(LabHand& hand) {
  for (int i = 0; i < 20'000 && hand.window().message().kind == Message::Kind::none; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    hand.frame();
  }
}

TEST(LabWindow, AFilmThatDoesNotFitTheMemoryIsRefusedAndTheOldSceneStays) {
  const TempFolder folder;
  std::ofstream(folder / "huge.xml") << R"(<scene version="3.0.0"><sensor type="perspective">
    <film type="hdrfilm"><integer name="width" value="16000"/>
      <integer name="height" value="16000"/></film></sensor>
    <shape type="sphere"/><emitter type="constant"/></scene>)";
  if (memory_refusal(16000, 16000, lane_count).empty()) {
    GTEST_SKIP() << "this machine has more memory than any picture needs";
  }
  LabHand hand;
  const auto scene = hand.state().request.store.scene;
  hand.driver().drop(folder / "huge.xml");
  wait_for_message(hand);
  const Message said = hand.window().message();
  EXPECT_EQ(said.kind, Message::Kind::error);
  EXPECT_NE(said.text.find("16000x16000 would take about"), std::string::npos) << said.text;
  EXPECT_NE(said.text.find("huge.xml"), std::string::npos) << said.text;
  EXPECT_EQ(hand.state().request.store.scene, scene);
  EXPECT_EQ(hand.state().request.store.settings.width, 96);
}

TEST(LabWindow, ASizeThatDoesNotFitTheMemoryGivesWayToTheOneBefore) {
  LabHand hand;
  hand.state().request.store.settings.width = 1 << 20;
  hand.state().request.store.settings.height = 1 << 16;
  hand.settle();
  EXPECT_EQ(hand.state().request.store.settings.width, 96);
  EXPECT_EQ(hand.state().request.store.settings.height, 54);
  EXPECT_EQ(hand.window().message().kind, Message::Kind::error);
  EXPECT_NE(hand.window().message().text.find("1048576x65536"), std::string::npos)
      << hand.window().message().text;
  EXPECT_EQ(hand.snapshot().pass, 5u);
}

TEST(LabWindow, WhatIsNoFileIsNamedWhenItIsDropped) {
  const TempFolder folder;
  LabHand hand;
  for (const char* name : {"pipe.xml", "pipe.EXR"}) {
    SCOPED_TRACE(name);
    ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
    hand.driver().drop(folder / name);
    wait_for_message(hand);
    EXPECT_EQ(hand.window().message().kind, Message::Kind::error);
    EXPECT_NE(hand.window().message().text.find(name), std::string::npos)
        << hand.window().message().text;
    hand.click("message");
  }
  hand.driver().drop("/dev/zero");
  wait_for_message(hand);
  EXPECT_NE(hand.window().message().text.find("/dev/zero"), std::string::npos)
      << hand.window().message().text;
}

TEST(LabWindow, EscapeEndsWhatIsBeingLoadedAndNothingElse) {
  LabHand hand;
  hand.state().layout = LabLayout::large;
  hand.state().pinned = glm::ivec2(3, 3);
  hand.frames(2);
  EXPECT_FALSE(hand.has("cancel"));
  hand.state().can_cancel = true;  // as while a scene is loaded
  hand.window().key({key_escape, true, false, false});
  EXPECT_TRUE(hand.state().cancel);
  EXPECT_TRUE(hand.state().pinned);
  hand.frames(2);
  EXPECT_FALSE(hand.state().cancel);
  EXPECT_EQ(hand.window().message().text, "cancelled");
  hand.key(key_escape);
  EXPECT_FALSE(hand.state().pinned);
}

TEST(LabWindow, QuitsByItsKey) {
  LabHand hand;
  EXPECT_FALSE(hand.state().quit);
  hand.key('q');
  EXPECT_TRUE(hand.state().quit);
}

TEST(LabWindow, ExposureStaysWithinWhatAFloatHolds) {
  LabHand hand;
  for (const bool shift : {false, true}) {
    for (int i = 0; i < 1000; ++i) {
      hand.window().key({'e', true, shift, false});
    }
    hand.frame();
    EXPECT_EQ(hand.state().view.exposure, shift ? -largest_exposure : largest_exposure);
  }
}

TEST(LabWindow, CornersOfAlmostNoRadiusAreDrawn) {
  const LabHand hand;
  ImDrawList list(ImGui::GetDrawListSharedData());
  list._ResetForNewFrame();
  // A hair wider than two pixels, which leaves a hair for the corners.
  list.AddRectFilled({0, 0}, {2.0000005f, 20}, IM_COL32_WHITE, 4.0f);
  EXPECT_GT(list.VtxBuffer.Size, 0);
}

TEST(LabWindow, IsDrawnAtAnySize) {
  LabHand hand;
  hand.key('d');
  for (const LabLayout layout : {LabLayout::columns, LabLayout::grid, LabLayout::large}) {
    hand.state().layout = layout;
    hand.state().comparison.wipe = !hand.state().comparison.wipe;
    for (const auto& [width, height] : {std::pair(1, 1),
                                        {20, 1100},
                                        {1100, 20},
                                        {1, 700},
                                        {900, 1},
                                        {50, 50},
                                        {200, 150},
                                        {640, 480}}) {
      SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
      ImGui::GetIO().DisplaySize = {float(width), float(height)};
      hand.move(0.5f * float(width), 0.5f * float(height));
      hand.wheel(0.5f * float(width), 0.5f * float(height), 1.0f);
      const glm::vec2 center = hand.state().pan_zoom.center;
      EXPECT_TRUE(center.x >= 0.0f && center.x <= 1.0f && center.y >= 0.0f && center.y <= 1.0f);
    }
  }
}

TEST(LabWindow, AFailureCaseComesWithItsViewAndSaysWhatToLookAt) {
  LabHand hand;
  const FailureCase& failure = find_failure_case("dim-noise");
  hand.choose("scene", "failure." + std::string(failure.id));
  for (int i = 0; i < 2000 && hand.state().failure != &failure; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    hand.frame();
  }
  ASSERT_EQ(hand.state().failure, &failure);
  EXPECT_EQ(hand.state().scene, failure.scene);
  EXPECT_EQ(hand.state().slots[2][1].kind, find_view(failure.view).key);
  EXPECT_EQ(hand.state().pan_zoom.zoom, failure.zoom);
  EXPECT_EQ(hand.window().message().text, failure.watch);
  // Another scene is no failure case any more.
  hand.choose("scene", "synthetic:" + std::string(synthetics().front().id));
  for (int i = 0; i < 2000 && hand.state().failure; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    hand.frame();
  }
  EXPECT_EQ(hand.state().failure, nullptr);
  hand.settle();
  EXPECT_EQ(hand.driver().error(), "");
}

TEST(LabWindow, TheScaleOfTextAndControlsChangesWhileItRuns) {
  LabHand hand;
  const float slider = hand.rect("lane0.threshold0").height;
  const auto before = hand.screen();
  hand.choose("layout", "scale.1.5");
  EXPECT_EQ(hand.state().ui_scale, 1.5f);
  EXPECT_EQ(hand.window().ui().scale, 1.5f);
  EXPECT_NEAR(hand.rect("lane0.threshold0").height, 1.5f * slider, 3.0f);
  hand.choose("layout", "scale.0");
  hand.move(-100.0f, -100.0f);
  EXPECT_EQ(hand.window().ui().scale, 1.0f) << "as the display says";
  EXPECT_TRUE(std::ranges::equal(hand.screen().pixels(), before.pixels()))
      << "the fonts are the ones of before";
}

TEST(LabWindow, SlidersAreLongEnoughForAHandInTheSmallestWindow) {
  LabHand hand(1280, 720);
  for (const LabLayout layout : {LabLayout::columns, LabLayout::grid, LabLayout::large}) {
    hand.state().layout = layout;
    hand.frames(3);
    std::size_t seen = 0;
    for (const auto& [name, box] : hand.window().ui().widgets) {
      if (name.ends_with(".multiplier")) {
        ++seen;
        EXPECT_GT(box.width, 60.0f) << name << " in layout " << layout_row(layout).id;
      } else if (name.find(".threshold") != std::string::npos && !name.ends_with(".number")) {
        ++seen;
        EXPECT_GE(box.width, 40.0f) << name << " in layout " << layout_row(layout).id;
      }
    }
    EXPECT_EQ(seen, layout == LabLayout::large ? 4u : 10u) << "a lane's multiplier and thresholds";
  }
}

TEST(LabWindow, NoTooltipLiesOverTheNumberOfASliderThatIsHeld) {
  LabHand hand(1280, 720);
  const auto alone = hand.pixels("lane1.threshold0.number");
  const ScreenRect knob = hand.rect("lane1.threshold0");
  hand.move(knob.center_x(), knob.center_y());
  EXPECT_NE(hand.pixels("lane1.threshold0.number"), alone) << "the tooltip, where it would lie";
  hand.press(true);
  EXPECT_EQ(hand.pixels("lane1.threshold0.number"), alone);
  hand.press(false);
}

TEST(LabWindow, ASliderKeepsItsLengthWhileTheNumbersBesideItChange) {
  LabHand hand(1280, 720);
  hand.state().layout = LabLayout::grid;
  hand.frames(3);
  const ScreenRect before = hand.rect("lane1.threshold0");
  const float numbers = hand.rect("lane1.numbers").width;
  hand.state().request.lanes.settings[1].thresholds[0] = 1000.0f;  // every pixel is done
  hand.settle();
  EXPECT_NE(hand.rect("lane1.numbers").width, numbers);
  EXPECT_EQ(hand.rect("lane1.threshold0").width, before.width);
}

TEST(LabWindow, NothingLeavesTheWindow) {
  for (const auto& [width, height] : {std::pair(1280, 720), {1600, 1000}, {3840, 2160}}) {
    LabHand hand(width, height);
    for (const LabLayout layout : {LabLayout::columns, LabLayout::grid, LabLayout::large}) {
      hand.state().layout = layout;
      hand.frames(3);
      for (const auto& [name, box] : hand.window().ui().widgets) {
        EXPECT_GE(box.x, 0.0f) << name;
        EXPECT_GE(box.y, 0.0f) << name;
        EXPECT_LE(box.right(), float(width)) << name << " at " << width << "x" << height;
        EXPECT_LE(box.bottom(), float(height)) << name << " at " << width << "x" << height;
      }
    }
  }
}

}  // namespace
}  // namespace quartet
