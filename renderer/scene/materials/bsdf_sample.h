#pragma once

#include <glm/glm.hpp>

namespace quartet {

// What materials are asked at a point. Directions are unit vectors in the local frame of the
// shading normal (+z, the front) and point away from the surface: `wo` towards where the path came
// from, `wi` towards where it goes on.

struct BsdfValue {
  glm::vec3 f_cos{0.0f};  ///< BSDF × |cos θi|, 1/sr
  float pdf = 0.0f;       ///< of sampling wi, 1/sr
};

struct BsdfSample {
  glm::vec3 wi{0.0f};
  glm::vec3 weight{0.0f};  ///< f cos / pdf; zero ends the path
  float pdf = 0.0f;        ///< 1/sr; 0 for a specular direction, which has none
  bool specular = false;
  float eta_scale = 1.0f;  ///< (index left / index entered)² undone, for Russian roulette
};

}  // namespace quartet
