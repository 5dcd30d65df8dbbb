#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <initializer_list>

#include "renderer/scene/scene.h"
#include "tests/fuzz/feed.h"

namespace quartet {

inline void promise_finite(std::initializer_list<float> numbers, const char* where) {
  for (const float number : numbers) {
    promise(std::isfinite(number), std::string("a number is not finite in ") + where);
  }
}

inline void promise_finite(const glm::vec3& v, const char* where) {
  promise_finite({v.x, v.y, v.z}, where);
}

/// What everybody who uses a mesh takes for granted.
inline void promise_mesh(const Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  promise(mesh.normals.empty() || mesh.normals.size() == vertices, "not a normal for each vertex");
  promise(mesh.uvs.empty() || mesh.uvs.size() == vertices, "not a uv for each vertex");
  for (const glm::uvec3& triangle : mesh.triangles) {
    promise(triangle.x < vertices && triangle.y < vertices && triangle.z < vertices,
            "a triangle has a vertex that is not there");
  }
  for (const glm::vec3& position : mesh.positions) {
    promise_finite(position, "a position");
  }
  for (const glm::vec3& normal : mesh.normals) {
    promise_finite(normal, "a normal");
  }
  for (const glm::vec2& uv : mesh.uvs) {
    promise_finite({uv.x, uv.y}, "a uv");
  }
}

}  // namespace quartet
