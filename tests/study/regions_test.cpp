#include "renderer/study/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "renderer/scene/load_scene.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

constexpr int report_width = 480;
constexpr int report_height = 270;

const std::vector<RegionId>& found() {
  static const std::vector<RegionId> regions = [] {
    const TraceScene scene(load_scene(find_scene("cornell-checker")));
    RenderSettings settings = default_settings(scene.scene());
    settings.width = report_width;
    settings.height = report_height;
    return find_regions(scene, settings);
  }();
  return regions;
}

RegionId at(int x, int y) {
  return found()[std::size_t(y) * report_width + std::size_t(x)];
}

/// Where a point of the scene lies in the picture: the camera of the report in the report's words.
RegionId at_point(double x, double y, double z) {
  const double scale = 3.0 / (z + 800.0);  // tan of half the vertical field of view is 1/3
  const double across = (x - 278.0) * scale;
  const double up = (y - 273.0) * scale;
  return at(int(report_width / 2.0 + across * report_height / 2.0),
            int(report_height / 2.0 - up * report_height / 2.0));
}

TEST(Regions, EachIsSomewhereAndPixelsAddUp) {
  for (const Region& row : regions()) {
    EXPECT_GT(std::ranges::count(found(), row.key), 20) << row.id;
  }
  EXPECT_EQ(found().size(), std::size_t(report_width) * report_height);
}

TEST(Regions, LieWhereTheReportsSceneHasThem) {
  EXPECT_EQ(at(3, 100), RegionId::margin);
  EXPECT_EQ(at(report_width - 3, 100), RegionId::margin);
  EXPECT_EQ(at_point(278, 548.8, 450), RegionId::ceiling);
  EXPECT_EQ(at_point(0, 300, 300), RegionId::green_wall);
  EXPECT_EQ(at_point(556, 300, 300), RegionId::red_wall);
  EXPECT_EQ(at_point(400, 150, 150), RegionId::glass_ball);
  EXPECT_EQ(at_point(185, 225, 108.5), RegionId::mirror_ball);
  EXPECT_EQ(at_point(209, 80, 89), RegionId::box_front);
  // Straight below the ball, seen past its front; and the open floor before everything.
  EXPECT_EQ(at_point(440, 0, 190), RegionId::ball_shadow);
  EXPECT_EQ(at_point(350, 0, 60), RegionId::floor);
}

TEST(Regions, SquaresAlternateFromADarkOneInTheLowerLeftCorner) {
  // Rows of squares that nothing stands before.
  for (int row = 5; row < 7; ++row) {
    for (int column = 0; column < 7; ++column) {
      const RegionId expected =
          (row + column) % 2 == 0 ? RegionId::dark_squares : RegionId::bright_squares;
      EXPECT_EQ(at_point(70.0 * column + 35.0, 70.0 * row + 35.0, 559.2), expected)
          << row << ' ' << column;
    }
  }
}

TEST(Regions, BordersAndOutlinesAreAsTheirDefinitionsSay) {
  const auto is_wall = [](RegionId id) {
    return id == RegionId::bright_squares || id == RegionId::dark_squares ||
           id == RegionId::bright_borders || id == RegionId::dark_borders;
  };
  for (int y = 1; y + 1 < report_height; ++y) {
    for (int x = 1; x + 1 < report_width; ++x) {
      const RegionId here = at(x, y);
      for (int v = y - 1; v <= y + 1; ++v) {
        for (int u = x - 1; u <= x + 1; ++u) {
          const RegionId there = at(u, v);
          if (here == RegionId::bright_squares) {
            EXPECT_TRUE(there != RegionId::dark_squares && there != RegionId::dark_borders);
          }
          if (is_wall(here)) {
            EXPECT_TRUE(is_wall(there) || there == RegionId::outlines);
          }
          if (here == RegionId::green_wall) {
            EXPECT_TRUE(there == here || there == RegionId::outlines);
          }
        }
      }
    }
  }
  const auto bright = std::ranges::count(found(), RegionId::bright_borders);
  const auto dark = std::ranges::count(found(), RegionId::dark_borders);
  EXPECT_NEAR(double(bright) / double(dark), 1.0, 0.15) << "a border has two sides";
}

TEST(Regions, OtherScenesAreRefused) {
  const TraceScene scene(load_scene(find_scene("veach-plates")));
  const std::string error = error_of([&] { find_regions(scene, default_settings(scene.scene())); });
  EXPECT_NE(error.find("has no shape 'ceiling'"), std::string::npos) << error;
}

}  // namespace
}  // namespace quartet
