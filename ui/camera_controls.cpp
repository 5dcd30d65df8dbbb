#include "ui/camera_controls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "renderer/trace/camera_rays.h"

namespace quartet {
namespace {

/// `v` turned around a unit axis by an angle (Rodrigues).
glm::vec3 turned(glm::vec3 v, glm::vec3 axis, float angle) {
  const float c = std::cos(angle);
  const float s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * glm::dot(axis, v) * (1.0f - c);
}

Camera turned_around(const Camera& camera, glm::vec3 pivot, glm::vec3 axis, float angle) {
  Camera result = camera;
  result.origin = pivot + turned(camera.origin - pivot, axis, angle);
  result.right = glm::normalize(turned(camera.right, axis, angle));
  result.up = glm::normalize(turned(camera.up, axis, angle));
  result.forward = glm::normalize(turned(camera.forward, axis, angle));
  return result;
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
      if (scene.accel().closest_hit(ray, hit)) {
        depths.push_back(hit.t * glm::dot(ray.direction, camera.forward));
      }
    }
  }
  float depth = camera.focus_distance;
  if (!depths.empty()) {
    const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    depth = *middle;
  }
  return {camera, camera.origin + depth * camera.forward};
}

Camera orbit(const CameraControls& controls, const Camera& camera, float right, float up) {
  const glm::vec3 vertical = controls.home.up;
  // In a mirrored picture "right" is the other way around; the axes must follow.
  const float handed =
      glm::dot(glm::cross(camera.right, camera.up), camera.forward) < 0.0f ? 1.0f : -1.0f;
  Camera turned_right = turned_around(camera, controls.pivot, vertical, -handed * right);
  Camera result = turned_around(turned_right, controls.pivot, turned_right.right, -handed * up);
  constexpr float steepest = 0.985f;
  const float slope = glm::dot(result.forward, vertical);
  const bool steeper = std::abs(slope) > std::abs(glm::dot(turned_right.forward, vertical));
  return std::abs(slope) > steepest && steeper ? turned_right : result;
}

Camera dolly(const CameraControls& controls, const Camera& camera, float steps) {
  Camera result = camera;
  const float factor = std::exp(-0.11f * steps);
  result.origin = controls.pivot + (camera.origin - controls.pivot) * factor;
  return result;
}

}  // namespace quartet
