#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

namespace quartet {

class Element;
class ElementWriter;
class Hasher;
struct SceneBuilder;

/// The two-colour checkerboard of Mitsuba: the unit square of (to_uv · uv) holds 2 × 2 squares, and
/// the one at its origin shows color0.
struct Checkerboard {
  static constexpr std::string_view name = "checkerboard";

  glm::vec3 color0{0.4f};
  glm::vec3 color1{0.2f};
  glm::mat3 to_uv{1.0f};

  glm::vec3 at(glm::vec2 uv) const {
    const glm::vec3 p = to_uv * glm::vec3(uv, 1.0f);
    const bool right = p.x - glm::floor(p.x) >= 0.5f;
    const bool upper = p.y - glm::floor(p.y) >= 0.5f;
    return right == upper ? color0 : color1;
  }
  glm::vec3 mean() const { return 0.5f * (color0 + color1); }
  std::array<glm::vec3, 2> extremes() const { return {color0, color1}; }
  std::string text() const { return "a checkerboard"; }
  void add_to(Hasher& hasher) const;
  void write(ElementWriter& element) const;
  static Checkerboard read(SceneBuilder& builder, Element& element);
};

}  // namespace quartet
