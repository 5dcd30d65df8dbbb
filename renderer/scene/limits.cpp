#include "renderer/scene/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace quartet {
namespace {

/// Also false for what is not a number.
bool within(float value, double least, double most) {
  return value >= float(least) && value <= float(most);
}

std::string place_text(std::string_view what, const glm::vec3& p) {
  return fmt::format("{} is ({}, {}, {}), each coordinate must be from {} to {}", what, p.x, p.y,
                     p.z, -largest_coordinate, largest_coordinate);
}

std::string axes_fault(const Camera& camera) {
  constexpr float tolerance = 2e-3f;
  for (const glm::vec3& axis : {camera.right, camera.up, camera.forward}) {
    if (!(std::abs(glm::length(axis) - 1.0f) < tolerance)) {
      return fmt::format("right, up and forward must have length 1, ({}, {}, {}) has {}", axis.x,
                         axis.y, axis.z, glm::length(axis));
    }
  }
  for (const float cosine : {glm::dot(camera.right, camera.up), glm::dot(camera.up, camera.forward),
                             glm::dot(camera.forward, camera.right)}) {
    if (!(std::abs(cosine) < tolerance)) {
      return fmt::format(
          "right, up and forward must be at right angles, two of them are at {:.1f} degrees",
          glm::degrees(std::acos(cosine)));
    }
  }
  return {};
}

}  // namespace

bool is_position(const glm::vec3& p) {
  return within(p.x, -largest_coordinate, largest_coordinate) &&
         within(p.y, -largest_coordinate, largest_coordinate) &&
         within(p.z, -largest_coordinate, largest_coordinate);
}

std::string camera_fault(const Camera& camera) {
  if (!is_position(camera.origin)) {
    return place_text("origin", camera.origin);
  }
  if (std::string fault = axes_fault(camera); !fault.empty()) {
    return fault;
  }
  if (!within(camera.fov, least_fov, largest_fov)) {
    return fmt::format("fov is {} degrees, must be between {} and {}", camera.fov, least_fov,
                       largest_fov);
  }
  if (!within(camera.aperture_radius, 0.0, largest_coordinate)) {
    return fmt::format("aperture_radius is {}, must be from 0 to {}", camera.aperture_radius,
                       largest_coordinate);
  }
  if (!within(camera.focus_distance, smallest_extent, largest_coordinate)) {
    return fmt::format("focus_distance is {}, must be from {} to {}", camera.focus_distance,
                       smallest_extent, largest_coordinate);
  }
  return {};
}

std::string picture_size_fault(int width, int height) {
  for (const int side : {width, height}) {
    if (side < 1 || side > largest_picture_side) {
      return fmt::format("a picture of {} x {} pixels, each side must be from 1 to {}", width,
                         height, largest_picture_side);
    }
  }
  if (double(width) * double(height) > largest_picture) {
    return fmt::format("a picture of {} x {} pixels, at most {:.0f} pixels are possible", width,
                       height, largest_picture);
  }
  return {};
}

std::string position_fault(const glm::vec3& position) {
  return is_position(position) ? std::string() : place_text("its place", position);
}

std::string geometry_fault(const Shape& shape) {
  const auto [low, high] =
      std::visit([](const auto& geometry) { return geometry.box(); }, shape.geometry);
  for (const glm::vec3& corner : {low, high}) {
    if (!is_position(corner)) {
      return place_text("too far out to render: a corner of it", corner);
    }
  }
  const glm::vec3 size = high - low;
  const float extent = std::max({size.x, size.y, size.z});
  if (!(extent >= float(smallest_extent))) {
    return fmt::format("its extent is {:.3g}, must be at least {}", extent, smallest_extent);
  }
  const glm::vec3 farthest = glm::max(glm::abs(low), glm::abs(high));
  const float distance = std::max({farthest.x, farthest.y, farthest.z});
  if (distance > float(farthest_in_extents) * extent) {
    return fmt::format(
        "its extent is {:.3g} at a coordinate of {:.3g}, which can be at most {} times as large",
        extent, distance, farthest_in_extents);
  }
  return {};
}

}  // namespace quartet
