#include "renderer/scene/mesh/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "renderer/base/cancel.h"

namespace quartet {
namespace {

using Outline = std::vector<glm::dvec2>;

double twice_area(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double area(const Outline& outline) {
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    sum += 0.5 * twice_area({}, outline[i], outline[(i + 1) % outline.size()]);
  }
  return sum;
}

/// Whether a point that is not on the border lies inside.
bool is_inside(const Outline& outline, glm::dvec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i];
    const glm::dvec2 b = outline[(i + 1) % outline.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
      inside = !inside;
    }
  }
  return inside;
}

/// Triangles of `outline` seen along an axis, which together must be what it encloses.
void expect_covered(const Outline& outline, const std::vector<glm::uvec3>& triangles) {
  const double sign = area(outline) > 0.0 ? 1.0 : -1.0;
  double sum = 0.0;
  for (const glm::uvec3& t : triangles) {
    const glm::dvec2 a = outline.at(t.x);
    const glm::dvec2 b = outline.at(t.y);
    const glm::dvec2 c = outline.at(t.z);
    const double signed_area = 0.5 * twice_area(a, b, c);
    EXPECT_GT(sign * signed_area, 0.0) << "turned over, or empty";
    sum += signed_area;
    for (const glm::dvec3 weights :
         {glm::dvec3(0.34, 0.33, 0.33), {0.9, 0.05, 0.05}, {0.05, 0.9, 0.05}, {0.05, 0.05, 0.9}}) {
      EXPECT_TRUE(is_inside(outline, weights.x * a + weights.y * b + weights.z * c)) << "outside";
    }
  }
  EXPECT_NEAR(sum, area(outline), 1e-9 * std::abs(sum));
}

/// Cuts the outline as it lies in each of three planes, from each corner on, in both directions.
void expect_cut(const Outline& outline) {
  for (std::size_t start = 0; start < outline.size(); ++start) {
    for (const bool backwards : {false, true}) {
      Outline turned = outline;
      std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(start), turned.end());
      if (backwards) {
        std::reverse(turned.begin(), turned.end());
      }
      for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE("start " + std::to_string(start) + (backwards ? " backwards" : "") +
                     " across axis " + std::to_string(axis));
        std::vector<glm::vec3> corners;
        for (const glm::dvec2& p : turned) {
          glm::vec3 corner(0.0f);
          corner[(axis + 1) % 3] = float(p.x);
          corner[(axis + 2) % 3] = float(p.y);
          corner[axis] = 0.25f * float(p.x) + 7.0f;
          corners.push_back(corner);
        }
        std::vector<glm::uvec3> triangles;
        EXPECT_EQ(cut_polygon(corners, triangles), PolygonCut::whole);
        expect_covered(turned, triangles);
      }
    }
  }
}

TEST(Polygon, RightAngledShapesFromEveryCornerInBothDirections) {
  const std::vector<std::pair<std::string, Outline>> shapes{
      {"L", {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}},
      {"T", {{0, 0}, {1, 0}, {1, 2}, {2, 2}, {2, 3}, {-1, 3}, {-1, 2}, {0, 2}}},
      {"U", {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}},
      {"E",
       {{0, 0},
        {3, 0},
        {3, 1},
        {1, 1},
        {1, 2},
        {3, 2},
        {3, 3},
        {1, 3},
        {1, 4},
        {3, 4},
        {3, 5},
        {0, 5}}},
      {"stairs", {{0, 0}, {4, 0}, {4, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}, {1, 4}, {0, 4}}},
      {"door", {{0, 0}, {1, 0}, {1, 2}, {2, 2}, {2, 0}, {3, 0}, {3, 3}, {0, 3}}},
      {"plus",
       {{1, 0},
        {2, 0},
        {2, 1},
        {3, 1},
        {3, 2},
        {2, 2},
        {2, 3},
        {1, 3},
        {1, 2},
        {0, 2},
        {0, 1},
        {1, 1}}},
      {"arrow", {{0, 0}, {2, 1}, {0, 2}, {0.5, 1}}},
      {"dart, quad", {{0, 0}, {4, 0}, {1, 1}, {0, 4}}},
      {"corners along straight borders",
       {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}},
      {"quad that is a triangle", {{0, 0}, {1, 0}, {2, 0}, {1, 2}}},
  };
  for (const auto& [name, outline] : shapes) {
    SCOPED_TRACE(name);
    expect_cut(outline);
  }
}

TEST(Polygon, ASpiralAndAStar) {
  Outline spiral;
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.4 * i;
    spiral.emplace_back((1.0 + 0.2 * i) * std::cos(angle), (1.0 + 0.2 * i) * std::sin(angle));
  }
  for (int i = 39; i >= 0; --i) {
    const double angle = 0.4 * i;
    spiral.emplace_back((1.7 + 0.2 * i) * std::cos(angle), (1.7 + 0.2 * i) * std::sin(angle));
  }
  Outline star;
  for (int i = 0; i < 26; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 26.0;
    const double radius = i % 2 == 0 ? 5.0 : 0.5 + 0.1 * i;
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  for (const Outline& outline : {spiral, star}) {
    std::vector<glm::vec3> corners;
    Outline rounded;
    for (const glm::dvec2& p : outline) {
      corners.emplace_back(float(p.x), float(p.y), 0.0f);
      rounded.emplace_back(corners.back());
    }
    std::vector<glm::uvec3> triangles;
    EXPECT_EQ(cut_polygon(corners, triangles), PolygonCut::whole);
    EXPECT_EQ(triangles.size(), outline.size() - 2);
    expect_covered(rounded, triangles);
  }
}

TEST(Polygon, AHoleTiedToTheBorderStaysFree) {
  // The border, a way in, the hole the other way around, and the same way out.
  const Outline outline{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0},
                        {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}};
  std::vector<glm::vec3> corners;
  for (const glm::dvec2& p : outline) {
    corners.emplace_back(p.x, p.y, 0.0);
  }
  std::vector<glm::uvec3> triangles;
  cut_polygon(corners, triangles);
  expect_covered(outline, triangles);
  EXPECT_EQ(area(outline), 8.0);
}

TEST(Polygon, RepeatedCornersAndSpikesChangeNothing) {
  const std::vector<glm::vec3> corners{{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                       {3, 1, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0},
                                       {1, 2, 0}, {0, 2, 0}, {0, 0, 0}};
  std::vector<glm::uvec3> triangles;
  cut_polygon(corners, triangles);
  double sum = 0.0;
  for (const glm::uvec3& t : triangles) {
    const double signed_area = 0.5 * twice_area(glm::dvec2(corners[t.x]), glm::dvec2(corners[t.y]),
                                                glm::dvec2(corners[t.z]));
    EXPECT_GE(signed_area, 0.0);
    sum += signed_area;
  }
  EXPECT_EQ(sum, 3.0);
}

TEST(Polygon, WhatCrossesItselfIsSaidToDoSo) {
  const auto cut = [](const std::vector<glm::vec3>& corners) {
    std::vector<glm::uvec3> triangles;
    const PolygonCut result = cut_polygon(corners, triangles);
    EXPECT_FALSE(triangles.empty());
    return result;
  };
  EXPECT_EQ(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), PolygonCut::crossing) << "bow tie";
  EXPECT_EQ(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 3, 0}}), PolygonCut::crossing);
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), PolygonCut::crossing) << "a line";
  std::vector<glm::vec3> pentagram;
  for (int i = 0; i < 5; ++i) {
    const float angle = 0.8f * float(i) * std::numbers::pi_v<float>;
    pentagram.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
  }
  EXPECT_EQ(cut(pentagram), PolygonCut::crossing);
}

/// Teeth in the direction of `axis`, each of two corners.
std::vector<glm::vec3> comb(int corners, int axis) {
  std::vector<glm::vec3> result{{0.0f, 0.0f, 0.0f}};
  result.back()[1 - axis] = float(corners);
  for (int i = 0; i < corners - 2; ++i) {
    glm::vec3 p(0.0f);
    p[1 - axis] = float(corners - i);
    p[axis] = i % 2 == 0 ? 100.0f : 1.0f;
    result.push_back(p);
  }
  result.emplace_back(0.0f);
  return result;
}

TEST(Polygon, HasManyCornersButNotAnyNumber) {
  for (const int axis : {0, 1}) {
    const std::vector<glm::vec3> corners = comb(20'000, axis);
    std::vector<glm::uvec3> triangles;
    EXPECT_EQ(cut_polygon(corners, triangles), PolygonCut::whole);
    EXPECT_EQ(triangles.size(), corners.size() - 2);
  }
  std::vector<glm::uvec3> none;
  EXPECT_EQ(cut_polygon(comb(int(most_concave_corners) + 1, 0), none), PolygonCut::too_many);
  EXPECT_TRUE(none.empty());
}

TEST(Polygon, CanBeCancelled) {
  std::stop_source stop;
  stop.request_stop();
  std::vector<glm::uvec3> triangles;
  EXPECT_THROW(cut_polygon(comb(20000, 0), triangles, stop.get_token()), Cancelled);
}

}  // namespace
}  // namespace quartet
