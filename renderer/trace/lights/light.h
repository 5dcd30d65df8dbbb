#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/trace/accel.h"
#include "renderer/trace/lights/light_sample.h"
#include "renderer/trace/surface.h"

namespace quartet {

struct Light;

/// How lights of a family are sampled; each family has a file, whose add_lights() hands it out.
struct LightFamily {
  /// Towards the light from a point; (u, v) in [0, 1)² chooses the direction. The density holds the
  /// light's probability.
  LightSample (*sample)(const Light& light, const Scene& scene, glm::vec3 from, float u, float v);
  /// The density (1/sr) with which sample finds the point `surface` of a shape; `direction` is the
  /// unit vector there and `distance` the way. It holds the light's probability too. Null for
  /// lights that are no shapes.
  float (*pdf)(const Light& light, const Surface& surface, glm::vec3 from, glm::vec3 direction,
               float distance);
  /// Radiance times area times π; `radius` is that of the scene.
  double (*power)(const Light& light, const Scene& scene, float radius);
};

/// Onto what (u, v) are mapped where eight lights are sampled at a time; lights that are sampled
/// alone have a way of their own.
enum class LightDomain { square, triangle, disk, point, alone };

/// What eight lights at a time are sampled by; of one light, or of eight.
template <class F>
struct LightRowOf {
  Vec3<F> origin{};  ///< a corner, or the centre
  Vec3<F> edge1{};   ///< of a disk: two radii at right angles
  Vec3<F> edge2{};
  Vec3<F> normal{};    ///< of flat lights
  Vec3<F> radiance{};  ///< where no texture varies it; of a point, W/sr
  F density{};         ///< of a point of a shape's light: probability / area
};
using LightRow = LightRowOf<float>;
using LightRow8 = LightRowOf<Float8>;

/// What is chosen as one: a piece of a shape that shines, a light without extent, the environment.
struct alignas(64) Light {
  LightRow row{};
  const LightFamily* family = nullptr;
  LightDomain domain = LightDomain::alone;
  bool textured = false;
  float radius = 0.0f;          ///< of disks and spheres
  float area = 0.0f;            ///< of shapes
  std::uint32_t shape = 0;      ///< index into Scene::shapes
  std::uint32_t primitive = 0;  ///< of a mesh
  float probability = 0.0f;     ///< of being chosen
};

// What shines becomes lights: each kind of geometry, of light without extent and of environment has
// one of these, in the file of the family that samples it.

void add_lights(const Mesh& mesh, std::uint32_t shape, std::vector<Light>& lights);
void add_lights(const Sphere& sphere, std::uint32_t shape, std::vector<Light>& lights);
void add_lights(const Disk& disk, std::uint32_t shape, std::vector<Light>& lights);
void add_lights(const PointLight& point, std::vector<Light>& lights);
void add_lights(const ConstantEnvironment& environment, std::vector<Light>& lights);

// What families of shapes share.

/// Density (1/sr) of a direction where a point of the light is sampled evenly.
float area_pdf(const Light& light, const Surface& surface, glm::vec3 direction, float distance);
double area_power(const Light& light, const Scene& scene, float radius);
/// At a point of the light; `hit` says where on a mesh that is.
glm::vec3 radiance_at(const Light& light, const Scene& scene, glm::vec3 position, const Hit& hit);

}  // namespace quartet
