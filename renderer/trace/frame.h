#pragma once

#include "renderer/base/math/wide.h"

namespace quartet {

/// An orthonormal basis around a unit normal: Duff et al., "Building an Orthonormal Basis,
/// Revisited", JCGT 6(1), 2017.
template <class F>
struct FrameOf {
  Vec3<F> s, t, n;

  explicit FrameOf(Vec3<F> normal) : n(normal) {
    const F sign = copysign(1.0f, n.z);
    const F a = -1.0f / (sign + n.z);
    const F b = n.x * n.y * a;
    s = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t = {b, sign + n.y * n.y * a, -n.y};
  }

  Vec3<F> to_world(Vec3<F> v) const { return v.x * s + v.y * t + v.z * n; }
  Vec3<F> to_local(Vec3<F> v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
};
using Frame = FrameOf<float>;

}  // namespace quartet
