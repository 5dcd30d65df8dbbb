#pragma once

#include <glm/glm.hpp>

namespace quartet {

/// The corners of a box along the axes. One whose numbers are not finite, or lie farther out than
/// limits.h allows, stands for a shape that has such a corner.
struct Box {
  glm::vec3 low{0.0f};
  glm::vec3 high{0.0f};
};

}  // namespace quartet
