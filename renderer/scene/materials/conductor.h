#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "renderer/scene/materials/bsdf_sample.h"
#include "renderer/scene/materials/metal.h"

namespace quartet {

/// A smooth metal: a mirror with Fresnel's reflectance.
struct Conductor {
  static constexpr std::string_view name = "conductor";

  Metal metal;

  struct AtPoint {
    static constexpr bool specular = true;
    static constexpr bool transmits = false;

    Metal::AtPoint metal;

    BsdfSample sample(glm::vec3 wo, float /*u*/, float /*v*/) const {
      BsdfSample s;
      s.wi = {-wo.x, -wo.y, wo.z};
      s.weight = metal.fresnel(wo.z);
      s.specular = true;
      return s;
    }
  };

  template <class Lookup>
  AtPoint at(const Lookup& color) const {
    return {metal.at(color)};
  }
  std::array<Color, 1> colors() const { return {metal.reflectance}; }
  std::string text(const Textures& textures) const { return metal.text(textures); }
  void add_to(Hasher& hasher) const;
  void write(ElementWriter& element) const;
  static Conductor read(SceneBuilder& builder, Element& element);
};

}  // namespace quartet
