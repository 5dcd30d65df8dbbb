#pragma once

#include "renderer/scene/scene.h"
#include "renderer/trace/accel.h"
#include "renderer/trace/sampler.h"

namespace quartet {

/// A camera at one resolution: picture points to rays.
class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);

  /// The ray of pixel (x, y), counted from the top left, with its draws: position in
  /// the pixel (box filter) and on the lens.
  Ray ray(int x, int y, const Sampler::Draws& draws) const;

 private:
  glm::vec3 origin_;
  glm::vec3 top_left_;  // of the picture, on the plane at distance 1 along `forward`
  glm::vec3 dx_, dy_;   // one pixel to the right, one down, on that plane
  glm::vec3 lens_x_, lens_y_;
  float focus_distance_;
};

}  // namespace quartet
