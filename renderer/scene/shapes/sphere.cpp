#include "renderer/scene/shapes/sphere.h"

#include <array>
#include <cmath>
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

Geometry read_sphere(SceneBuilder& /*builder*/, Element& element) {
  const glm::dmat4 to_world = element.transform("to_world");
  const glm::dvec3 center = element.point("center", glm::dvec3(0.0));
  const double radius = element.positive("radius", 1.0);
  const glm::dmat3 linear = glm::dmat3(to_world) * radius;
  if (!are_circle_axes(linear[0], linear[1]) || !are_circle_axes(linear[1], linear[2]) ||
      !are_circle_axes(linear[2], linear[0])) {
    element.fail(
        "to_world of a sphere scales unevenly or shears, expected the same scale in x, y "
        "and z");
  }
  const double determinant = glm::determinant(linear);
  const double world_radius = std::cbrt(std::abs(determinant));
  // Mitsuba takes a mirroring as a negative radius, which exchanges inside and outside.
  const bool mirrored = determinant < 0.0;
  Sphere result;
  result.center = glm::vec3(to_world * glm::dvec4(center, 1.0));
  result.radius = float(world_radius);
  result.flip_normals = element.boolean("flip_normals", false) != mirrored;
  result.to_local = glm::mat3(glm::inverse(linear) * (mirrored ? -world_radius : world_radius));
  return result;
}

}  // namespace

double Sphere::area() const {
  return 4.0 * glm::pi<double>() * double(radius) * double(radius);
}

void Sphere::add_to(Hasher& hasher) const {
  const auto& [place, size, inside_out, axes] = *this;
  hasher.add_all(place, size, inside_out, axes);
}

void Sphere::write(ElementWriter& element) const {
  element.set_type(name);
  if (to_local == glm::mat3(1.0f)) {
    element.point("center", center);
    element.number("radius", radius);
  } else {
    const glm::mat3& m = to_local;
    const std::array axes = rounded_to(
        std::array{m[0].x, m[0].y, m[0].z, m[1].x, m[1].y, m[1].z, m[2].x, m[2].y, m[2].z},
        [](std::array<double, 9>& values) {
          const double size = std::cbrt(std::abs(glm::determinant(glm::make_mat3(values.data()))));
          for (double& value : values) value /= size;
        });
    glm::dmat4 to_world(glm::inverse(glm::dmat3(glm::make_mat3(axes.data()))) * double(radius));
    to_world[3] = glm::dvec4(glm::dvec3(center), 1.0);
    element.transform("to_world", to_world);
  }
  if (flip_normals) element.boolean("flip_normals", true);
}

constexpr ShapeRow sphere_row{Sphere::name, read_sphere};

}  // namespace quartet
