#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "renderer/base/math/warp.h"
#include "renderer/scene/materials/bsdf_sample.h"
#include "renderer/scene/textures/texture.h"

namespace quartet {

/// Reflects into all directions alike (Lambert).
struct Diffuse {
  static constexpr std::string_view name = "diffuse";

  Color reflectance{glm::vec3(0.5f)};  ///< albedo

  struct AtPoint {
    static constexpr bool specular = false;
    static constexpr bool transmits = false;

    glm::vec3 reflectance;

    BsdfValue evaluate(glm::vec3 /*wo*/, glm::vec3 wi) const {
      const float pdf = wi.z * (1.0f / pi);
      return {reflectance * pdf, pdf};
    }
    BsdfSample sample(glm::vec3 /*wo*/, float u, float v) const {
      BsdfSample s;
      s.wi = square_to_cosine_hemisphere(u, v);
      s.pdf = s.wi.z * (1.0f / pi);
      s.weight = s.pdf > 0.0f ? reflectance : glm::vec3(0.0f);
      return s;
    }
  };

  template <class Lookup>
  AtPoint at(const Lookup& color) const {
    return {color(reflectance)};
  }
  std::array<Color, 1> colors() const { return {reflectance}; }
  std::string text(const Textures& textures) const;
  void add_to(Hasher& hasher) const;
  void write(ElementWriter& element) const;
  static Diffuse read(SceneBuilder& builder, Element& element);
};

}  // namespace quartet
