#include "renderer/trace/bsdf.h"

#include <cmath>

namespace quartet {

Bsdf bsdf_at(const Scene& scene, const Material& material, glm::vec2 uv) {
  const auto color = [&](const Color& slot) { return color_at(scene.textures, slot, uv); };
  return std::visit(
      [&](const auto& kind) -> Bsdf {
        return {kind.at(color), material.two_sided};
      },
      material.kind);
}

BsdfValue evaluate(const Bsdf& bsdf, glm::vec3 wo, glm::vec3 wi) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> BsdfValue {
        if constexpr (Kind::specular) {
          return {};
        } else {
          static_assert(!Kind::transmits,
                        "say here on which sides a rough material that transmits is evaluated");
          if (wo.z * wi.z <= 0.0f || (wo.z < 0.0f && !bsdf.two_sided)) {
            return {};
          }
          return wo.z < 0.0f ? kind.evaluate({wo.x, wo.y, -wo.z}, {wi.x, wi.y, -wi.z})
                             : kind.evaluate(wo, wi);
        }
      },
      bsdf.kind);
}

BsdfSample sample(const Bsdf& bsdf, glm::vec3 wo, float u, float v) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> BsdfSample {
        if constexpr (Kind::transmits) {
          return kind.sample(wo, u, v);
        } else {
          const bool below = wo.z < 0.0f;
          if (wo.z == 0.0f || (below && !bsdf.two_sided)) {
            return {};
          }
          BsdfSample s = kind.sample({wo.x, wo.y, std::abs(wo.z)}, u, v);
          s.wi.z = below ? -s.wi.z : s.wi.z;
          return s;
        }
      },
      bsdf.kind);
}

}  // namespace quartet
