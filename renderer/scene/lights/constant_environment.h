#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "renderer/base/math/wide.h"

namespace quartet {

class Element;
class ElementWriter;
class Hasher;
struct SceneBuilder;

/// The same radiance from every direction.
struct ConstantEnvironment {
  static constexpr std::string_view name = "constant";

  glm::vec3 radiance{0.0f};

  /// What arrives against a direction, or against eight.
  glm::vec3 at(glm::vec3 /*direction*/) const { return radiance; }
  Vec8 at(const Vec8& /*directions*/) const { return splat(radiance); }
  bool shines() const { return radiance != glm::vec3(0.0f); }
  std::string text() const;
  void add_to(Hasher& hasher) const;
  void write(ElementWriter& element) const;
  static ConstantEnvironment read(SceneBuilder& builder, Element& element);
};

}  // namespace quartet
