#pragma once

#include <glm/glm.hpp>
#include <variant>

#include "renderer/scene/scene.h"

namespace quartet {

template <class Family>
struct KindsAtPoint;
template <class... Kinds>
struct KindsAtPoint<std::variant<Kinds...>> {
  using type = std::variant<typename Kinds::AtPoint...>;
};

/// A material at one surface point, textures looked up. bsdf_sample.h says what directions are.
struct Bsdf {
  KindsAtPoint<MaterialKind>::type kind;
  bool two_sided;
};

Bsdf bsdf_at(const Scene& scene, const Material& material, glm::vec2 uv);

/// Reflects or transmits into single directions only: light sampling is useless there.
inline bool is_specular(const Bsdf& bsdf) {
  return std::visit([]<class Kind>(const Kind& /*kind*/) { return Kind::specular; }, bsdf.kind);
}

/// Zero for specular materials and for directions on different sides.
BsdfValue evaluate(const Bsdf& bsdf, glm::vec3 wo, glm::vec3 wi);

/// (u, v) in [0, 1)² chooses the direction; for a dielectric, u between reflection and
/// transmission.
BsdfSample sample(const Bsdf& bsdf, glm::vec3 wo, float u, float v);

}  // namespace quartet
