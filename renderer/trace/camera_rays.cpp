#include "renderer/trace/camera_rays.h"

#include <cmath>

namespace quartet {
namespace {

/// Half the picture's width on the plane at distance 1.
float half_width(const Camera& camera, float aspect) {
  const float tangent = std::tan(glm::radians(0.5f * camera.fov));
  switch (camera.fov_axis) {
    case FovAxis::x:
      return tangent;
    case FovAxis::y:
      return tangent * aspect;
    case FovAxis::smaller:
      return aspect < 1.0f ? tangent : tangent * aspect;
    case FovAxis::larger:
      return aspect < 1.0f ? tangent * aspect : tangent;
    case FovAxis::diagonal:
      break;
  }
  return tangent * aspect / std::sqrt(1.0f + aspect * aspect);
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : origin_(camera.origin),
      lens_x_(camera.aperture_radius * camera.right),
      lens_y_(camera.aperture_radius * camera.up),
      focus_distance_(camera.focus_distance) {
  const float aspect = float(width) / float(height);
  const float half_x = half_width(camera, aspect);
  const float half_y = half_x / aspect;
  dx_ = camera.right * (2.0f * half_x / float(width));
  dy_ = camera.up * (-2.0f * half_y / float(height));
  top_left_ = camera.forward - half_x * camera.right + half_y * camera.up;
}

}  // namespace quartet
