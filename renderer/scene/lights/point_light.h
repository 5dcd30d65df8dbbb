#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>

namespace quartet {

class Element;
class ElementWriter;
class Hasher;
struct SceneBuilder;

/// Shines alike in all directions from a point.
struct PointLight {
  static constexpr std::string_view name = "point";

  glm::vec3 position{0.0f};
  glm::vec3 intensity{1.0f};  ///< power per solid angle: radiance times an area

  bool shines() const { return intensity != glm::vec3(0.0f); }
  double power() const;
  std::string text() const;
  void add_to(Hasher& hasher) const;
  void write(ElementWriter& element) const;
  static PointLight read(SceneBuilder& builder, Element& element);
};

}  // namespace quartet
