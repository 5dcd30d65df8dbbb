#pragma once

#include "renderer/base/math/warp.h"
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
  Ray ray(int x, int y, const Sampler::Draws& draws) const {
    return ray(float(x), float(y), draws);
  }
  /// The same for one ray or eight, with x and y whole numbers.
  template <class F, class Draws>
  RayOf<F> ray(F x, F y, const Draws& draws) const {
    const Vec3<F> on_plane = top_left_ + (x + draws[0]) * dx_ + (y + draws[1]) * dy_;
    RayOf<F> ray{origin_ + Vec3<F>{}, on_plane};
    if (lens_x_ != glm::vec3(0.0f)) {
      const Vec2<F> lens = square_to_disk(draws[2], draws[3]);
      const Vec3<F> shift = lens.x * lens_x_ + lens.y * lens_y_;
      ray.origin += shift;
      ray.direction = focus_distance_ * on_plane - shift;
    }
    ray.direction = normalize(ray.direction);
    return ray;
  }

 private:
  glm::vec3 origin_;
  glm::vec3 top_left_;  // of the picture, on the plane at distance 1 along `forward`
  glm::vec3 dx_, dy_;   // one pixel to the right, one down, on that plane
  glm::vec3 lens_x_, lens_y_;
  float focus_distance_;
};

}  // namespace quartet
