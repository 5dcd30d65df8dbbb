// The dock under the lanes: errors against a reference, by mouse and keys.

#include "ui/window/dock.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "renderer/files/exr.h"
#include "renderer/files/png.h"
#include "tests/files/temp_folder.h"
#include "tests/session/true_errors.h"
#include "tests/ui/lab_hand.h"

namespace quartet {
namespace {

/// A window with a reference that it has computed.
class MeasuredHand : public LabHand {
 public:
  explicit MeasuredHand(int width = 1600, int height = 1000) : LabHand(width, height) {
    state().reference_form.spp = 64;
    key('d');
    click("dock.compute");
    key('d');
    state().dock.open.reset();
    settle();
    frames(3);
  }
};

TEST(Dock, IsABarUntilItIsUnfolded) {
  LabHand hand;
  EXPECT_LT(hand.rect("dock.box").height, 40.0f);
  EXPECT_FALSE(hand.has("dock.compute"));
  const float lanes = hand.rect("lane0.slot1").bottom();
  hand.click("dock");
  EXPECT_GT(hand.rect("dock.box").height, 140.0f);
  EXPECT_TRUE(hand.has("dock.compute"));
  EXPECT_LT(hand.rect("lane0.slot1").bottom(), lanes);
  hand.key('d');
  EXPECT_LT(hand.rect("dock.box").height, 40.0f);
}

TEST(Dock, AReferenceIsComputedAndOpensItWhereThereIsRoom) {
  {
    MeasuredHand tall;
    ASSERT_TRUE(tall.state().request.lanes.reference);
    EXPECT_TRUE(tall.has("dock.chart"));
    EXPECT_TRUE(tall.has("table.row4")) << "four lanes and uniform sampling";
    for (const LaneSnapshot& lane : tall.snapshot().lanes) {
      ASSERT_EQ(lane.history.size(), 5u);
      for (const PassRecord& record : lane.history) {
        EXPECT_GT(record.truth.error, 0.0);
      }
    }
  }
  MeasuredHand low(1280, 720);
  ASSERT_TRUE(low.state().request.lanes.reference);
  EXPECT_FALSE(low.has("dock.chart"));
  const float picture = low.rect("lane0.slot0").height;
  low.key('d');
  EXPECT_TRUE(low.has("dock.chart"));
  EXPECT_GT(low.rect("lane0.slot0").height, 0.7f * picture);
}

TEST(Dock, ItsEdgeIsDragged) {
  MeasuredHand hand;
  const ScreenRect before = hand.rect("dock.box");
  const float picture = hand.rect("lane0.slot0").height;
  hand.drag(800.0f, before.y, 800.0f, before.y - 120.0f);
  EXPECT_NEAR(hand.rect("dock.box").height, before.height + 120.0f, 3.0f);
  EXPECT_LT(hand.rect("lane0.slot0").height, picture);
  // The lanes keep half, the dock what it needs to be read.
  hand.drag(800.0f, hand.rect("dock.box").y, 800.0f, 5.0f);
  EXPECT_LT(hand.rect("dock.box").height, 0.51f * 1000.0f);
  hand.drag(800.0f, hand.rect("dock.box").y, 800.0f, 995.0f);
  EXPECT_GT(hand.rect("dock.box").height, 100.0f);
}

TEST(Dock, MetricAndAxisAreChosen) {
  MeasuredHand hand;
  const auto before = hand.pixels("dock.chart");
  hand.choose("dock.effort", "spp");
  hand.move(-100.0f, -100.0f);
  EXPECT_EQ(hand.state().dock.effort, Effort::mean_spp);
  EXPECT_NE(hand.pixels("dock.chart"), before);
  const double relmse = hand.snapshot().lanes[2].history.back().truth.error;
  hand.choose("dock.metric", "mse");
  hand.settle();
  EXPECT_EQ(hand.snapshot().metric, MetricId::mse);
  EXPECT_NE(hand.snapshot().lanes[2].history.back().truth.error, relmse);
}

TEST(Dock, ADraggedThresholdMovesItsLanesCurveAlone) {
  MeasuredHand hand;
  std::vector<std::vector<double>> before;
  for (const LaneSnapshot& lane : hand.snapshot().lanes) {
    before.push_back(test::true_errors(lane));
  }
  const auto chart = hand.pixels("dock.chart");
  hand.drag("lane1.threshold0", -40.0f);
  hand.move(-100.0f, -100.0f);
  hand.settle();
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    EXPECT_EQ(test::true_errors(hand.snapshot().lanes[lane]) != before[lane], lane == 1);
  }
  EXPECT_NE(hand.pixels("dock.chart"), chart);
}

TEST(Dock, AHeldKeyShowsTheReferenceInEveryColumn) {
  MeasuredHand hand;
  const auto before = hand.pixels("lane1.slot0");
  hand.window().key({'x', true, false, false});
  hand.frames(3);
  const auto held = hand.pixels("lane1.slot0");
  EXPECT_NE(held, before);
  // Pictures that lie elsewhere may round their pixels the other way.
  const auto there = hand.pixels("lane3.slot0");
  ASSERT_EQ(there.size(), held.size());
  const auto differing = [](const std::vector<Rgba8>& a, const std::vector<Rgba8>& b) {
    return std::transform_reduce(a.begin(), a.end(), b.begin(), 0, std::plus(),
                                 std::not_equal_to());
  };
  EXPECT_LT(differing(there, held), differing(before, held) / 10);
  hand.window().key({'x', false, false, false});
  hand.frames(3);
  EXPECT_EQ(hand.pixels("lane1.slot0"), before);
}

TEST(Dock, TrueErrorIsAView) {
  MeasuredHand hand;
  const auto before = hand.pixels("lane0.slot1");
  hand.choose("lane0.slot1.view", "true-error");
  hand.move(-100.0f, -100.0f);
  hand.frames(3);
  EXPECT_NE(hand.pixels("lane0.slot1"), before);
  EXPECT_TRUE(hand.has("lane0.slot1.key")) << "a colour bar";
}

TEST(Dock, ADroppedPictureOfAnyFormatIsAReferenceAndSaysWhatWasDoneToIt) {
  const TempFolder folder;
  write_png(folder / "photo", DisplayImage(96, 54, Rgba8{255, 255, 255, 255}));
  MeasuredHand hand;
  hand.driver().drop(folder / "photo");
  hand.frame();
  hand.settle();
  ASSERT_TRUE(hand.state().request.lanes.reference);
  EXPECT_EQ(hand.state().request.lanes.reference->at(95, 53), glm::vec3(1.0f));
  EXPECT_EQ(hand.window().message().kind, Message::Kind::notice);
  EXPECT_NE(hand.window().message().text.find("photo: it is display-referred"), std::string::npos)
      << hand.window().message().text;
}

TEST(Dock, ARefusedReferenceIsNamedWithItsReasonAndTheOldOneStays) {
  const TempFolder folder;
  ExrImage other(5, 4);
  other.add_radiance(RadianceImage(5, 4, glm::vec3(1.0f)));
  write_exr(folder / "other.exr", other);
  MeasuredHand hand;
  const auto before = hand.state().request.lanes.reference;
  hand.driver().drop(folder / "other.exr");
  hand.frame();
  hand.settle();
  ASSERT_EQ(hand.window().message().kind, Message::Kind::error);
  EXPECT_NE(hand.window().message().text.find("5x4"), std::string::npos)
      << hand.window().message().text;
  EXPECT_EQ(hand.state().request.lanes.reference, before);

  // One that fits is taken.
  ExrImage right(96, 54);
  right.add_radiance(RadianceImage(96, 54, glm::vec3(0.5f)));
  write_exr(folder / "right.exr", right);
  hand.click("reference");
  hand.click("reference.path");
  hand.type((folder / "right.exr").string());
  hand.settle();
  ASSERT_TRUE(hand.state().request.lanes.reference);
  EXPECT_EQ(hand.state().request.lanes.reference->at(0, 0), glm::vec3(0.5f));
}

TEST(Dock, AnotherSizeOrCameraHasNoReferenceAndNoError) {
  MeasuredHand hand;
  hand.state().request.store.settings.width = 48;
  hand.settle();
  EXPECT_FALSE(hand.state().request.lanes.reference);
  EXPECT_EQ(hand.driver().error(), "");
  EXPECT_EQ(hand.snapshot().width, 48);
  EXPECT_FALSE(hand.snapshot().reference);
}

TEST(Dock, QualityOfEachEstimatorIsPlotted) {
  MeasuredHand hand;
  hand.choose("dock.view", "1");
  EXPECT_FALSE(hand.has("dock.chart"));
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    EXPECT_TRUE(hand.has("dock.quality" + std::to_string(lane)));
  }
}

TEST(Dock, EqualisedLanesTakeTheSameSamples) {
  LabHand hand;
  hand.click("equalise");
  hand.click("equalise.spp");
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (hand.window().message().kind == Message::Kind::none &&
         std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    hand.frame();
  }
  EXPECT_EQ(hand.window().message().kind, Message::Kind::notice) << hand.window().message().text;
  hand.settle();
  const double wanted = double(hand.state().equalise_form.spp);
  for (const LaneSnapshot& lane : hand.snapshot().lanes) {
    EXPECT_NEAR(double(lane.history.back().samples) / double(hand.snapshot().pixels()), wanted,
                0.011 * wanted);
  }
}

TEST(Dock, NothingOfItLeavesTheWindow) {
  for (const auto& [width, height] : {std::pair(1280, 720), {1600, 1000}, {3840, 2160}}) {
    MeasuredHand hand(width, height);
    hand.state().dock.open = true;
    for (const LabLayout layout : {LabLayout::columns, LabLayout::grid, LabLayout::large}) {
      hand.state().layout = layout;
      hand.frames(3);
      const ScreenRect dock = hand.rect("dock.box");
      for (const auto& [name, box] : hand.window().ui().widgets) {
        EXPECT_GE(box.y, 0.0f) << name;
        EXPECT_LE(box.right(), float(width) + 0.5f) << name << " at " << width << "x" << height;
        EXPECT_LE(box.bottom(), float(height) + 0.5f) << name << " at " << width << "x" << height;
        if (name.starts_with("lane") && box.height > 0.0f) {
          EXPECT_LE(box.bottom(), dock.y + 0.5f) << name << " at " << width << "x" << height;
        }
      }
    }
  }
}

}  // namespace
}  // namespace quartet
