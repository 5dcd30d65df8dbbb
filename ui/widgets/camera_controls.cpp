#include "ui/widgets/camera_controls.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "renderer/scene/limits.h"
#include "renderer/trace/camera_rays.h"

namespace quartet {
namespace {

struct DistanceRange {
  double least, most;
};

/// How near to the pivot and how far from it a camera may go.
DistanceRange distances(const CameraControls& controls) {
  constexpr double span = 1e4;
  const glm::dvec3 pivot(controls.pivot);
  const double farthest = std::max({std::abs(pivot.x), std::abs(pivot.y), std::abs(pivot.z)});
  const double home =
      std::max(glm::length(glm::dvec3(controls.home.origin) - pivot), smallest_extent);
  // Nearer than some steps of a float at the pivot the camera would hop.
  constexpr double float_steps = 2e-6;
  return {std::min(home, std::max(home / span, float_steps * farthest)),
          std::max(home, std::min(home * span, largest_coordinate - farthest))};
}

/// `v` turned around a unit axis by an angle (Rodrigues).
glm::dvec3 turned(glm::dvec3 v, glm::dvec3 axis, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * glm::dot(axis, v) * (1.0 - c);
}

/// The camera at a distance from the pivot. Its axes are made orthogonal again: many small turns
/// would add up their rounding.
Camera placed(const CameraControls& controls, const Camera& camera, glm::dvec3 direction,
              double distance) {
  Camera result = camera;
  result.origin = glm::vec3(glm::dvec3(controls.pivot) + direction * distance);
  const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.forward));
  glm::dvec3 right(camera.right);
  right = glm::normalize(right - forward * glm::dot(right, forward));
  glm::dvec3 up(camera.up);
  up = glm::normalize(up - forward * glm::dot(up, forward) - right * glm::dot(up, right));
  result.forward = glm::vec3(forward);
  result.right = glm::vec3(right);
  result.up = glm::vec3(up);
  return result;
}

/// Where the camera is, seen from the pivot: a direction and a distance.
std::pair<glm::dvec3, double> place_of(const CameraControls& controls, const Camera& camera) {
  const glm::dvec3 offset = glm::dvec3(camera.origin) - glm::dvec3(controls.pivot);
  const double distance = glm::length(offset);
  return distance > 0.0 ? std::pair(offset / distance, distance)
                        : std::pair(-glm::dvec3(camera.forward), 0.0);
}

Camera turned_around(const CameraControls& controls, const Camera& camera, glm::vec3 axis,
                     float angle) {
  const glm::dvec3 unit = glm::normalize(glm::dvec3(axis));
  const auto turn = [&](const glm::vec3& v) {
    return glm::vec3(turned(glm::dvec3(v), unit, double(angle)));
  };
  Camera result = camera;
  result.right = turn(camera.right);
  result.up = turn(camera.up);
  result.forward = turn(camera.forward);
  const auto [direction, distance] = place_of(controls, camera);
  const DistanceRange range = distances(controls);
  return placed(controls, result, turned(direction, unit, double(angle)),
                std::max(distance, range.least));
}

/// The camera that was asked for if the tracer can take it.
Camera possible(const Camera& before, const Camera& wanted) {
  return camera_fault(wanted).empty() ? wanted : before;
}

}  // namespace

CameraControls camera_controls(const TraceScene& scene) {
  constexpr int grid = 9;
  const Camera& camera = scene.scene().camera;
  const CameraRays rays(camera, grid, grid);
  std::vector<float> depths;
  for (int y = 0; y < grid; ++y) {
    for (int x = 0; x < grid; ++x) {
      const Ray ray = rays.ray(x, y, {0.5f, 0.5f, 0.5f, 0.5f});
      Hit hit;
      if (!scene.accel().closest_hit(ray, hit)) {
        continue;
      }
      const float depth = hit.t * glm::dot(ray.direction, camera.forward);
      if (depth > 0.0f && std::isfinite(depth)) {
        depths.push_back(depth);
      }
    }
  }
  float depth = camera.focus_distance;
  if (!depths.empty()) {
    const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    depth = *middle;
  }
  // Without surfaces the focus may lie beyond all that can be looked at.
  return {camera, glm::clamp(camera.origin + depth * camera.forward, -float(largest_coordinate),
                             float(largest_coordinate))};
}

Camera orbit(const CameraControls& controls, const Camera& camera, float right, float up) {
  const glm::vec3 vertical = controls.home.up;
  // In a mirrored picture "right" is the other way around; the axes must follow.
  const float handed =
      glm::dot(glm::cross(camera.right, camera.up), camera.forward) < 0.0f ? 1.0f : -1.0f;
  const Camera turned_right = turned_around(controls, camera, vertical, -handed * right);
  const Camera result = turned_around(controls, turned_right, turned_right.right, -handed * up);
  constexpr float steepest = 0.985f;
  const float slope = glm::dot(result.forward, vertical);
  const bool steeper = std::abs(slope) > std::abs(glm::dot(turned_right.forward, vertical));
  return possible(camera, std::abs(slope) > steepest && steeper ? turned_right : result);
}

Camera dolly(const CameraControls& controls, const Camera& camera, float steps) {
  const auto [direction, distance] = place_of(controls, camera);
  const DistanceRange range = distances(controls);
  // So many that the way is at its end, whatever was asked for.
  constexpr float most_steps = 1000.0f;
  const double factor = std::exp(-0.11 * double(std::clamp(steps, -most_steps, most_steps)));
  const double wanted = std::clamp(std::max(distance, range.least) * factor, range.least,
                                   std::max(range.most, distance));
  return possible(camera, placed(controls, camera, direction, wanted));
}

}  // namespace quartet
