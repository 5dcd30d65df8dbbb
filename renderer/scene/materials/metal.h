#pragma once

#include <glm/glm.hpp>
#include <string>

#include "renderer/scene/materials/fresnel.h"
#include "renderer/scene/textures/texture.h"

namespace quartet {

/// What smooth and rough conductors are made of.
struct Metal {
  Color reflectance{glm::vec3(1.0f)};  ///< a factor on the reflected radiance
  glm::vec3 eta{0.0f};                 ///< real part of the index of refraction
  glm::vec3 k{1.0f};                   ///< extinction; eta = 0 reflects everything

  struct AtPoint {
    glm::vec3 reflectance;
    glm::vec3 eta;
    glm::vec3 k;

    glm::vec3 fresnel(float cos_i) const { return reflectance * fresnel_conductor(cos_i, eta, k); }
  };

  template <class Lookup>
  AtPoint at(const Lookup& color) const {
    return {color(reflectance), eta, k};
  }
  std::string text(const Textures& textures) const;
  void write(ElementWriter& element) const;
  /// `material`, or `eta` and `k`; and `specular_reflectance`. Throws SceneError.
  static Metal read(SceneBuilder& builder, Element& element);
};

}  // namespace quartet
