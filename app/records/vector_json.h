#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace quartet {

/// [x, y, z]
inline nlohmann::ordered_json vector_json(glm::vec3 v) {
  return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

}  // namespace quartet
