#include "ui/paper/label_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace quartet {
namespace {

TEST(LabelPlaces, StayWhereThereIsRoom) {
  EXPECT_EQ(label_places({10, 30, 90}, 10, 0, 100), (std::vector<double>{10, 30, 90}));
  EXPECT_TRUE(label_places({}, 10, 0, 100).empty());
}

TEST(LabelPlaces, ThatWouldTouchMoveApartByAsMuch) {
  EXPECT_EQ(label_places({50, 50}, 10, 0, 100), (std::vector<double>{45, 55}));
  EXPECT_EQ(label_places({50, 52, 54}, 10, 0, 100), (std::vector<double>{42, 52, 62}));
  // Two that met push a third.
  EXPECT_EQ(label_places({50, 50, 62}, 10, 0, 100), (std::vector<double>{44, 54, 64}));
}

TEST(LabelPlaces, StayWithin) {
  EXPECT_EQ(label_places({-5, 0, 1}, 10, 0, 100), (std::vector<double>{0, 10, 20}));
  EXPECT_EQ(label_places({97, 99}, 10, 0, 100), (std::vector<double>{80, 90}));
}

TEST(LabelPlaces, NeverOverlapAsLongAsThereIsRoomForAll) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-20.0, 320.0);
  for (int count = 1; count <= 30; ++count) {
    std::vector<double> wanted(static_cast<std::size_t>(count));
    std::ranges::generate(wanted, [&] { return place(random); });
    std::ranges::sort(wanted);
    const std::vector<double> found = label_places(wanted, 10.0, 0.0, 300.0);
    ASSERT_EQ(found.size(), wanted.size());
    EXPECT_GE(found.front(), 0.0);
    EXPECT_LE(found.back(), 290.0 + 1e-9);
    for (std::size_t i = 1; i < found.size(); ++i) {
      EXPECT_GE(found[i] - found[i - 1], 10.0 - 1e-9);
    }
  }
}

}  // namespace
}  // namespace quartet
