#include "renderer/scene/mesh/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "renderer/base/cancel.h"
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

Mesh make_rectangle(const glm::dmat4& to_world, bool flip_normals) {
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const bool mirrored = glm::determinant(glm::dmat3(to_world)) < 0.0;
  if (mirrored != flip_normals) {
    // Exchanging the two edges turns the front around and keeps the order of a parallelogram.
    std::swap(mesh.positions[1], mesh.positions[3]);
    std::swap(mesh.uvs[1], mesh.uvs[3]);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parallelogram = true;
  transform(mesh, to_world);
  return mesh;
}

Mesh make_cube(const glm::dmat4& to_world, bool face_normals, bool flip_normals) {
  // One row a face: the corner with uv (0, 0), the directions of u and of v; v × u points outward.
  struct Face {
    glm::vec3 corner, u, v;
  };
  constexpr std::array faces = {
      Face{{-1, -1, -1}, {0, 0, 2}, {2, 0, 0}}, Face{{1, 1, 1}, {-2, 0, 0}, {0, 0, -2}},
      Face{{1, -1, 1}, {0, 2, 0}, {0, 0, -2}},  Face{{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}},
      Face{{-1, -1, -1}, {0, 2, 0}, {0, 0, 2}}, Face{{-1, 1, -1}, {0, -2, 0}, {2, 0, 0}},
  };
  Mesh mesh;
  for (const Face& face : faces) {
    const unsigned first = unsigned(mesh.positions.size());
    for (const glm::vec2 uv :
         {glm::vec2(0, 0), glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0)}) {
      mesh.positions.push_back(face.corner + uv.x * face.u + uv.y * face.v);
      mesh.normals.push_back(glm::normalize(glm::cross(face.v, face.u)));
      mesh.uvs.push_back(uv);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  }
  transform(mesh, to_world);
  // As in Mitsuba, only the vertex normals know that a mirrored cube still faces outward.
  if (!face_normals) orient_by_normals(mesh);
  mesh.normals.clear();
  if (flip_normals) flip(mesh);
  return mesh;
}

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

double surface_area(const Shape& shape) {
  struct Area {
    double operator()(const Mesh& mesh) const {
      double sum = 0.0;
      for (const glm::uvec3& triangle : mesh.triangles) {
        sum += 0.5 * glm::length(area_normal(corners(mesh, triangle)));
      }
      return sum;
    }
    double operator()(const Sphere& sphere) const {
      return 4.0 * glm::pi<double>() * double(sphere.radius) * double(sphere.radius);
    }
    double operator()(const Disk& disk) const {
      return glm::pi<double>() * double(disk.radius) * double(disk.radius);
    }
  };
  return std::visit(Area{}, shape.geometry);
}

}  // namespace quartet
