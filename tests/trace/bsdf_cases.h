#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/trace/bsdf.h"

namespace quartet::test {

// Gold at 580 nm, roughly.
inline const glm::vec3 gold_eta(0.143f, 0.375f, 1.442f);
inline const glm::vec3 gold_k(3.983f, 2.386f, 1.603f);

inline const Metal gold{.eta = gold_eta, .k = gold_k};

inline Material make(const MaterialKind& kind) {
  Material material;
  material.kind = kind;
  return material;
}

struct BsdfCase {
  std::string name;
  Material material;
};

/// Every kind of material: colours, both metals, the whole range of roughness. Metals other than
/// gold reflect everything.
inline std::vector<BsdfCase> bsdf_cases() {
  std::vector<BsdfCase> all;
  const auto add = [&](const MaterialKind& kind, const std::string& name) {
    Material material = make(kind);
    all.push_back({name, material});
    if (!transmits(material)) {
      material.two_sided = true;
      all.push_back({name + ", two-sided", material});
    }
  };
  add(Diffuse{{{0.8f, 0.5f, 0.0f}}}, "diffuse");
  add(Conductor{gold}, "conductor gold");
  add(Conductor{}, "conductor mirror");
  for (const float alpha : {1e-4f, 0.005f, 0.02f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    const std::string detail = " alpha " + std::to_string(alpha);
    add(RoughConductor{{}, alpha}, "rough conductor" + detail);
    add(RoughConductor{gold, alpha}, "rough conductor gold" + detail);
  }
  add(Dielectric{.ior = 1.5f}, "dielectric");
  return all;
}

inline Bsdf bsdf_of(const Material& material) {
  return bsdf_at(Scene{}, material, glm::vec2(0.0f));
}

inline glm::vec3 direction(float cos_theta, float phi) {
  const float sine = std::sqrt(1.0f - cos_theta * cos_theta);
  return {sine * std::cos(phi), sine * std::sin(phi), cos_theta};
}

inline const std::vector<glm::vec3>& outgoing() {
  static const std::vector<glm::vec3> all{direction(1.0f, 0.0f), direction(0.9f, 0.5f),
                                          direction(0.6f, 2.0f), direction(0.3f, 4.0f),
                                          direction(0.05f, 5.5f)};
  return all;
}

}  // namespace quartet::test
