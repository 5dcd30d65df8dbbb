// What a view says of a pixel.

#include <gtest/gtest.h>

#include "renderer/view/views.h"
#include "tests/view/snapshot_cases.h"

namespace quartet {
namespace {

using Lines = std::vector<std::string>;

TEST(PixelLines, AreTheNumbersThatTheViewShows) {
  Snapshot snapshot = test::blank_snapshot(2, 1, std::array{EstimatorId::kl, EstimatorId::uniform});
  LaneSnapshot& lane = snapshot.lanes[0];
  lane.mean = {{{0.0f, 0.5f}, {0.0f, 2.0f}, {0.0f, 30.0f}}};
  snapshot.lanes[1].mean = {{{0.0f, 0.25f}, {0.0f, 2.0f}, {0.0f, 40.0f}}};
  lane.taken = {3, 12345};
  lane.rejected = {0, 7};
  lane.error = {0.0f, 3.0f * lane.settings.thresholds[0]};
  lane.variance = {0.0f, 1.0f, 0.0f, 2.0f, 0.0f, 3.0f};
  RadianceImage truth(2, 1);
  truth.pixels()[1] = {0.4f, 2.0f, 30.0f};
  snapshot.reference = std::make_shared<const RadianceImage>(truth);
  ViewSettings settings;
  settings.other = 1;
  const auto lines = [&](ViewKind kind) { return pixel_lines(snapshot, 0, kind, settings, 1); };
  EXPECT_EQ(lines(ViewKind::image), (Lines{"0.500", "2.00", "30.0"}));
  EXPECT_EQ(lines(ViewKind::heatmap), Lines{"12345"});
  EXPECT_EQ(lines(ViewKind::error), Lines{"3.00"});
  EXPECT_EQ(lines(ViewKind::variance), (Lines{"1.00", "2.00", "3.00"}));
  EXPECT_EQ(lines(ViewKind::stop_state), Lines{"12345"});
  EXPECT_EQ(lines(ViewKind::rejected), Lines{"7"});
  EXPECT_EQ(lines(ViewKind::difference), (Lines{"0.250", "0", "-10.0"}));
  EXPECT_EQ(lines(ViewKind::true_error), (Lines{"0.059", "0", "0"}));  // 0.1² / (0.4² + 0.01)
  EXPECT_EQ(lines(ViewKind::reference), (Lines{"0.400", "2.00", "30.0"}));
}

TEST(PixelLines, AreNoneWhereThereIsNothingToSee) {
  Snapshot snapshot = test::blank_snapshot(2, 1, std::array{EstimatorId::uniform});
  for (LaneSnapshot& lane : snapshot.lanes) {
    lane.error.clear();
    lane.variance.clear();
  }
  ViewSettings settings;
  settings.other = 1;  // there is none
  for (const ViewRow& row : views()) {
    const bool lacks = row.needs.variance || row.needs.reference || row.needs.other_lane ||
                       row.key == ViewKind::error;
    EXPECT_EQ(pixel_lines(snapshot, 0, row.key, settings, 1).empty(), lacks) << row.id;
  }
}

}  // namespace
}  // namespace quartet
