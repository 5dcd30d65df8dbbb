#include "renderer/scene/shapes/disk.h"

#include <algorithm>
#include <array>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/scene/hasher.h"
#include "renderer/scene/shapes/circle_axes.h"
#include "renderer/scene/shapes/shape_rows.h"
#include "renderer/scene/xml/element.h"
#include "renderer/scene/xml/element_writer.h"
#include "renderer/scene/xml/rounded.h"

namespace quartet {
namespace {

Geometry read_disk(SceneBuilder& /*builder*/, Element& element) {
  const glm::dmat4 to_world = element.transform("to_world");
  const glm::dmat3 linear(to_world);
  if (!are_circle_axes(linear[0], linear[1])) {
    element.fail(
        "to_world of a disk scales unevenly or shears, expected the same scale in x and y");
  }
  const glm::dvec3 normal =
      glm::normalize(glm::transpose(glm::inverse(linear)) * glm::dvec3(0.0, 0.0, 1.0));
  Disk result;
  result.center = glm::vec3(to_world[3]);
  result.normal = glm::vec3(element.boolean("flip_normals", false) ? -normal : normal);
  result.axis_u = glm::vec3(glm::normalize(linear[0]));
  result.axis_v = glm::vec3(glm::normalize(linear[1]));
  result.radius = float(glm::length(linear[0]));
  return result;
}

}  // namespace

Box Disk::box() const {
  const glm::vec3 reach = radius * glm::sqrt(glm::max(1.0f - normal * normal, 0.0f));
  return {center - reach, center + reach};
}

double Disk::area() const {
  return glm::pi<double>() * double(radius) * double(radius);
}

void Disk::add_to(Hasher& hasher) const {
  const auto& [place, front, u, v, size] = *this;
  hasher.add_all(place, front, u, v, size);
}

void Disk::write(ElementWriter& element) const {
  // The reader makes the normal anew, at right angles to both axes.
  const std::array axes =
      rounded_to(std::array{axis_u.x, axis_u.y, axis_u.z, axis_v.x, axis_v.y, axis_v.z, normal.x,
                            normal.y, normal.z},
                 [](std::array<double, 9>& values) {
                   glm::dmat3 m = glm::make_mat3(values.data());
                   m[2] = glm::normalize(m[2]);
                   for (int i = 0; i < 2; ++i)
                     m[i] = glm::normalize(m[i] - glm::dot(m[i], m[2]) * m[2]);
                   std::copy_n(glm::value_ptr(m), values.size(), values.begin());
                 });
  glm::dmat4 to_world(glm::dmat3(glm::make_mat3(axes.data())) * double(radius));
  to_world[3] = glm::dvec4(glm::dvec3(center), 1.0);
  element.set_type(name);
  element.transform("to_world", to_world);
}

constexpr ShapeRow disk_row{Disk::name, read_disk};

}  // namespace quartet
