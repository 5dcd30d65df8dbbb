#include "renderer/scene/mesh/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "renderer/base/cancel.h"
#include "renderer/scene/hasher.h"
#include "renderer/scene/limits.h"

namespace quartet {
namespace {

using Corners = std::array<glm::dvec3, 3>;

Corners corners(const Mesh& mesh, const glm::uvec3& triangle) {
  return {glm::dvec3(mesh.positions[triangle.x]), glm::dvec3(mesh.positions[triangle.y]),
          glm::dvec3(mesh.positions[triangle.z])};
}

/// Length: twice the area.
glm::dvec3 area_normal(const Corners& p) {
  return glm::cross(p[1] - p[0], p[2] - p[0]);
}

}  // namespace

void transform(Mesh& mesh, const glm::dmat4& to_world, const std::stop_token& stop) {
  CancelTick tick(stop);
  for (glm::vec3& position : mesh.positions) {
    tick();
    position = glm::vec3(to_world * glm::dvec4(position, 1.0));
  }
  const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(to_world)));
  for (glm::vec3& normal : mesh.normals) {
    tick();
    normal = glm::vec3(glm::normalize(normal_matrix * glm::dvec3(normal)));
  }
}

void orient_by_normals(Mesh& mesh, const std::stop_token& stop) {
  if (mesh.normals.empty()) return;
  CancelTick tick(stop);
  for (glm::uvec3& triangle : mesh.triangles) {
    tick();
    const glm::vec3 front =
        mesh.normals[triangle.x] + mesh.normals[triangle.y] + mesh.normals[triangle.z];
    if (glm::dot(area_normal(corners(mesh, triangle)), glm::dvec3(front)) < 0.0) {
      std::swap(triangle.y, triangle.z);
    }
  }
}

void flip(Mesh& mesh) {
  for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
  for (glm::vec3& normal : mesh.normals) normal = -normal;
}

void compute_normals(Mesh& mesh, const std::stop_token& stop) {
  CancelTick tick(stop);
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& triangle : mesh.triangles) {
    tick();
    const Corners p = corners(mesh, triangle);
    const glm::dvec3 normal = glm::normalize(area_normal(p));
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 a = glm::normalize(p[std::size_t(i + 1) % 3] - p[std::size_t(i)]);
      const glm::dvec3 b = glm::normalize(p[std::size_t(i + 2) % 3] - p[std::size_t(i)]);
      sums[triangle[i]] += normal * std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
    }
  }
  mesh.normals.clear();
  for (const glm::dvec3& sum : sums) {
    tick();
    // Opposite triangles cancel, and a vertex may belong to none: any direction is as good there.
    const double length = glm::length(sum);
    mesh.normals.push_back(length > 0.0 ? glm::vec3(sum / length) : glm::vec3(1.0f, 0.0f, 0.0f));
  }
}

void make_barycentric_uvs(Mesh& mesh, const std::stop_token& stop) {
  CancelTick tick(stop);
  Mesh split;
  for (const glm::uvec3& triangle : mesh.triangles) {
    tick();
    const unsigned first = unsigned(split.positions.size());
    for (int i = 0; i < 3; ++i) {
      split.positions.push_back(mesh.positions[triangle[i]]);
      if (!mesh.normals.empty()) split.normals.push_back(mesh.normals[triangle[i]]);
      split.uvs.emplace_back(i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f);
    }
    split.triangles.emplace_back(first, first + 1, first + 2);
  }
  mesh = std::move(split);
}

std::size_t drop_degenerate_triangles(Mesh& mesh, const std::stop_token& stop) {
  CancelTick tick(stop);
  return std::erase_if(mesh.triangles, [&](const glm::uvec3& triangle) {
    tick();
    const Corners p = corners(mesh, triangle);
    const double longest =
        std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[1]), glm::length(p[0] - p[2])});
    // A height below a billionth of the base is rounding of the corners, not a surface. What is far
    // below the smallest extent of a shape is no surface either, and products of its edges leave
    // the range of float.
    return longest < 1e-4 * smallest_extent ||
           glm::length(area_normal(p)) <= 1e-9 * longest * longest;
  });
}

Box Mesh::box() const {
  if (triangles.empty()) {
    return {};
  }
  const glm::vec3 first = positions[triangles.front().x];
  Box box{first, first};
  for (const glm::uvec3& triangle : triangles) {
    for (int i = 0; i < 3; ++i) {
      const glm::vec3 corner = positions[triangle[i]];
      if (!is_position(corner)) {
        return {corner, corner};  // a minimum would lose what is not a number
      }
      box.low = glm::min(box.low, corner);
      box.high = glm::max(box.high, corner);
    }
  }
  return box;
}

double Mesh::area() const {
  double sum = 0.0;
  for (const glm::uvec3& triangle : triangles) {
    sum += 0.5 * glm::length(area_normal(corners(*this, triangle)));
  }
  return sum;
}

std::string Mesh::text() const {
  return fmt::format("{} of {} triangles", name, triangles.size());
}

void Mesh::add_to(Hasher& hasher) const {
  const auto& [corner, normal, uv, triangle, is_parallelogram] = *this;
  hasher.add_all(corner, normal, uv, triangle, is_parallelogram);
}

}  // namespace quartet
