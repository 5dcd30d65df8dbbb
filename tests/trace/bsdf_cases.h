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

inline Material make(MaterialKind kind, glm::vec3 reflectance = glm::vec3(1.0f)) {
  Material material;
  material.kind = kind;
  material.reflectance.value = reflectance;
  return material;
}

/// A metal that reflects everything.
inline Material rough(float alpha) {
  Material material = make(MaterialKind::rough_conductor);
  material.alpha = alpha;
  return material;
}

inline Material gold(Material material) {
  material.eta = gold_eta;
  material.k = gold_k;
  return material;
}

inline Material glass(float ior) {
  Material material = make(MaterialKind::dielectric);
  material.ior = ior;
  return material;
}

struct BsdfCase {
  std::string name;
  Material material;
};

inline std::string name_of(MaterialKind kind) {
  switch (kind) {
    case MaterialKind::diffuse:
      return "diffuse";
    case MaterialKind::conductor:
      return "conductor";
    case MaterialKind::rough_conductor:
      return "rough conductor";
    case MaterialKind::dielectric:
      break;
  }
  return "dielectric";
}

/// Every kind of material: colours, both metals, the whole range of roughness.
inline std::vector<BsdfCase> bsdf_cases() {
  std::vector<BsdfCase> all;
  const auto add = [&](Material material, const std::string& detail) {
    all.push_back({name_of(material.kind) + detail, material});
    if (material.kind != MaterialKind::dielectric) {
      material.two_sided = true;
      all.push_back({name_of(material.kind) + detail + ", two-sided", material});
    }
  };
  add(make(MaterialKind::diffuse, {0.8f, 0.5f, 0.0f}), "");
  add(gold(make(MaterialKind::conductor)), " gold");
  add(make(MaterialKind::conductor), " mirror");
  for (const float alpha : {1e-4f, 0.005f, 0.02f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    const std::string detail = " alpha " + std::to_string(alpha);
    add(rough(alpha), detail);
    add(gold(rough(alpha)), " gold" + detail);
  }
  add(glass(1.5f), "");
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
