#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "renderer/scene/materials/bsdf_sample.h"
#include "renderer/scene/materials/ggx.h"
#include "renderer/scene/materials/metal.h"

namespace quartet {

/// A metal of microfacets: Walter et al. 2007, eq. 20, with GGX, sampled by visible normals.
struct RoughConductor {
  static constexpr std::string_view name = "roughconductor";

  Metal metal;
  float alpha = 0.1f;  ///< GGX roughness

  struct AtPoint {
    static constexpr bool specular = false;
    static constexpr bool transmits = false;

    Metal::AtPoint metal;
    float alpha;

    BsdfValue evaluate(glm::vec3 wo, glm::vec3 wi) const {
      const glm::vec3 m = glm::normalize(wo + wi);
      const float d_g1 = ggx_distribution(m, alpha) * ggx_masking(wo, alpha);
      const glm::vec3 fresnel = metal.fresnel(glm::dot(wo, m));
      BsdfValue value;
      value.f_cos = fresnel * (d_g1 * ggx_masking(wi, alpha) / (4.0f * wo.z));
      value.pdf = d_g1 / (4.0f * wo.z);
      return value;
    }
    BsdfSample sample(glm::vec3 wo, float u, float v) const {
      BsdfSample s;
      const glm::vec3 m = sample_visible_normal(wo, alpha, u, v);
      s.wi = 2.0f * glm::dot(wo, m) * m - wo;
      if (s.wi.z <= 0.0f) {
        return s;
      }
      const BsdfValue value = evaluate(wo, s.wi);
      s.pdf = value.pdf;
      s.weight = value.pdf > 0.0f ? value.f_cos / value.pdf : glm::vec3(0.0f);
      return s;
    }
  };

  template <class Lookup>
  AtPoint at(const Lookup& color) const {
    return {metal.at(color), alpha};
  }
  std::array<Color, 1> colors() const { return {metal.reflectance}; }
  std::string text(const Textures& textures) const;
  void add_to(Hasher& hasher) const;
  void write(ElementWriter& element) const;
  static RoughConductor read(SceneBuilder& builder, Element& element);
};

}  // namespace quartet
