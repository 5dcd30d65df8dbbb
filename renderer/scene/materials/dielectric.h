#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "renderer/scene/materials/bsdf_sample.h"
#include "renderer/scene/materials/fresnel.h"
#include "renderer/scene/textures/texture.h"

namespace quartet {

/// Smooth glass: reflects, or refracts to the other side. The inside is behind the front.
struct Dielectric {
  static constexpr std::string_view name = "dielectric";

  Color reflectance{glm::vec3(1.0f)};    ///< a factor on the reflected radiance
  Color transmittance{glm::vec3(1.0f)};  ///< a factor on the transmitted radiance
  float ior = 1.5046f;                   ///< index inside over index outside

  struct AtPoint {
    static constexpr bool specular = true;
    static constexpr bool transmits = true;

    glm::vec3 reflectance;
    glm::vec3 transmittance;
    float ior;

    BsdfSample sample(glm::vec3 wo, float u, float /*v*/) const {
      BsdfSample s;
      s.specular = true;
      const float cos_i = std::abs(wo.z);
      if (cos_i == 0.0f) {
        return s;
      }
      const float eta = wo.z > 0.0f ? ior : 1.0f / ior;
      float cos_t = 0.0f;
      const float reflected = fresnel_dielectric(cos_i, eta, cos_t);
      if (u < reflected) {
        s.wi = {-wo.x, -wo.y, wo.z};
        s.weight = reflectance;
        return s;
      }
      s.wi = {-wo.x / eta, -wo.y / eta, wo.z > 0.0f ? -cos_t : cos_t};
      // Radiance shrinks with the square of the index when it leaves the denser side (Veach 1997,
      // section 5.2); the path runs against the light.
      s.weight = transmittance / (eta * eta);
      s.eta_scale = eta * eta;
      return s;
    }
  };

  template <class Lookup>
  AtPoint at(const Lookup& color) const {
    return {color(reflectance), color(transmittance), ior};
  }
  std::array<Color, 2> colors() const { return {reflectance, transmittance}; }
  std::string text(const Textures& textures) const;
  void add_to(Hasher& hasher) const;
  void write(ElementWriter& element) const;
  static Dielectric read(SceneBuilder& builder, Element& element);
};

}  // namespace quartet
