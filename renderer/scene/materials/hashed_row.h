#pragma once

#include "renderer/scene/hasher.h"

namespace quartet {

/// How the first four kinds (diffuse, conductor, roughconductor, dielectric) are hashed: all
/// numbers of the four, the default where a kind lacks one. Scenes are known by the hashes that
/// this gives, and so are the references made of them; a kind that comes later hashes its own
/// fields alone.
struct HashedRow {
  Color reflectance;
  Color transmittance{glm::vec3(1.0f)};
  glm::vec3 eta{0.0f};
  glm::vec3 k{1.0f};
  float ior = 1.5046f;
  float alpha = 0.1f;

  void add_to(Hasher& hasher) const {
    hasher.add_all(reflectance, transmittance, eta, k, ior, alpha);
  }
};

}  // namespace quartet
