#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/scene.h"
#include "renderer/base/warp.h"

namespace quartet {

/// A material at one surface point, textures looked up. Directions are unit vectors in the local
/// frame of the shading normal (+z, the front) and point away from the surface: `wo` towards where
/// the path came from, `wi` towards where it goes on.
struct Bsdf {
  MaterialKind kind;
  bool two_sided;
  glm::vec3 reflectance;
  glm::vec3 transmittance;
  const Material* material;  ///< what no texture can vary
};

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

Bsdf bsdf_at(const Scene& scene, const Material& material, glm::vec2 uv);

/// Reflects or transmits into single directions only: light sampling is useless there.
inline bool is_specular(const Bsdf& bsdf) {
  return bsdf.kind == MaterialKind::conductor || bsdf.kind == MaterialKind::dielectric;
}

/// Zero for specular materials and for directions on different sides.
BsdfValue evaluate(const Bsdf& bsdf, glm::vec3 wo, glm::vec3 wi);

/// (u, v) in [0, 1)² chooses the direction; for a dielectric, u between reflection and
/// transmission.
BsdfSample sample(const Bsdf& bsdf, glm::vec3 wo, float u, float v);

/// Unpolarised Fresnel reflectance of a smooth dielectric. `cos_i` > 0; `eta` is the index on the
/// far side over the index on the near side; `cos_t` receives the cosine of the transmitted angle,
/// 0 at total internal reflection.
float fresnel_dielectric(float cos_i, float eta, float& cos_t);

/// The same for a conductor with complex index eta + i k relative to the near side.
glm::vec3 fresnel_conductor(float cos_i, glm::vec3 eta, glm::vec3 k);

}  // namespace quartet
