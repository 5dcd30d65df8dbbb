#include "renderer/trace/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "renderer/base/math/warp.h"
#include "renderer/trace/frame.h"
#include "renderer/trace/sampler.h"
#include "renderer/trace/trace_scene.h"
#include "tests/trace/test_scenes.h"

namespace quartet {
namespace {

using namespace test;

Surface hit_surface(const TraceScene& scene, glm::vec3 origin, glm::vec3 target) {
  const Ray ray{origin, glm::normalize(target - origin)};
  Hit hit{};
  EXPECT_TRUE(scene.accel().closest_hit(ray, hit));
  return scene.surface(ray, hit);
}

glm::vec3 direction(const float* u) {
  return square_to_uniform_cap(u[0], u[1], -1.0f);
}

/// Directions whose cosine with the normal goes down to 10^-decades, evenly over the powers.
glm::vec3 grazing(glm::vec3 normal, const float* u, float decades) {
  const float z = std::pow(10.0f, -decades * u[0]);
  const float r = std::sqrt(1.0f - z * z);
  const float phi = 2.0f * pi * u[1];
  return Frame(normal).to_world({r * std::cos(phi), r * std::sin(phi), z});
}

// No ray may meet the surface that it leaves: not at grazing angles, not where the shape is near
// the world's origin or far from it, larger or smaller than its distance from the camera.
TEST(Surface, RaysNeverMeetThePlaneTheyLeave) {
  struct Case {
    float half_size, from_origin, camera_distance;
  };
  for (const Case& c :
       {Case{1, 0, 1}, Case{10, 0, 13}, Case{1000, 0, 10}, Case{1, 1000, 5}, Case{275, 275, 1000},
        Case{1, 0, 1000}, Case{1e5f, 0, 2}, Case{1e-3f, 1e-2f, 0.1f}}) {
    int tested = 0;
    for (std::uint32_t plane = 0; plane < 20; ++plane) {
      Sampler sampler(1, plane, 0);
      const Sampler::Draws& d = sampler.next();
      const glm::vec3 center = c.from_origin * direction(&d[0]);
      const Frame frame(plane % 4 ? direction(&d[2]) : glm::vec3(0.0f, 1.0f, 0.0f));
      Scene scene;
      add_shape(scene,
                parallelogram(center - c.half_size * (frame.s + frame.t),
                              2.0f * c.half_size * frame.s, 2.0f * c.half_size * frame.t),
                diffuse(0.5f));
      const TraceScene trace(std::move(scene));
      for (std::uint32_t i = 0; i < 2000; ++i) {
        Sampler numbers(2, i, plane);
        std::array<float, 6> n{};
        std::copy_n(numbers.next(), 4, n.begin());
        std::copy_n(numbers.next(), 2, n.begin() + 4);
        const float reach =
            i % 2 ? 0.9f * c.half_size : std::min(0.9f * c.half_size, 0.01f * c.camera_distance);
        const glm::vec3 target =
            center + reach * ((2.0f * n[0] - 1.0f) * frame.s + (2.0f * n[1] - 1.0f) * frame.t);
        const glm::vec3 origin = target + c.camera_distance * direction(&n[2]);
        const Ray ray{origin, glm::normalize(target - origin)};
        Hit hit{};
        if (!trace.accel().closest_hit(ray, hit)) {
          continue;  // seen edge on
        }
        const Surface surface = trace.surface(ray, hit);
        const glm::vec3 onwards = grazing(i % 4 < 2 ? surface.normal : -surface.normal, &n[4], 6);
        const Ray next{offset_origin(surface, onwards), onwards};
        ASSERT_FALSE(trace.accel().closest_hit(next, hit))
            << "half size " << c.half_size << ", " << c.from_origin
            << " from the origin, camera at " << c.camera_distance << ", cosine "
            << glm::dot(onwards, surface.normal);
        ++tested;
      }
    }
    EXPECT_GT(tested, 39000);
  }
}

TEST(Surface, RaysNeverMeetTheSphereTheyLeaveTooEarly) {
  struct Case {
    float radius, from_origin, camera_distance;  // a negative one: the sphere touches the origin
  };
  for (const Case& c : {Case{1, 0, 3}, Case{100, 400, 1000}, Case{1000, -1, 10}, Case{0.03f, 6, 6},
                        Case{1, 1000, 10}, Case{0.01f, 0, 100}}) {
    int tested = 0;
    for (std::uint32_t place = 0; place < 20; ++place) {
      Sampler sampler(3, place, 0);
      const glm::vec3 away = direction(&sampler.next()[0]);
      Sphere sphere;
      sphere.center = (c.from_origin < 0.0f ? c.radius : c.from_origin) * away;
      sphere.radius = c.radius;
      Scene scene;
      add_shape(scene, sphere, diffuse(0.5f));
      const TraceScene trace(std::move(scene));
      for (std::uint32_t i = 0; i < 2000; ++i) {
        Sampler numbers(4, i, place);
        std::array<float, 6> n{};
        std::copy_n(numbers.next(), 4, n.begin());
        std::copy_n(numbers.next(), 2, n.begin() + 4);
        glm::vec3 target = direction(&n[0]);
        if (c.from_origin < 0.0f) {
          target = -glm::normalize(away + 0.01f * target);
        }
        target = sphere.center + c.radius * target;
        const glm::vec3 origin = target + c.camera_distance * direction(&n[2]);
        const Ray ray{origin, glm::normalize(target - origin)};
        Hit hit{};
        if (!trace.accel().closest_hit(ray, hit)) {
          continue;
        }
        const Surface surface = trace.surface(ray, hit);
        const bool inside = i % 2;
        const glm::vec3 onwards = grazing(inside ? -surface.normal : surface.normal, &n[4], 3);
        const Ray next{offset_origin(surface, onwards), onwards};
        const bool meets = trace.accel().closest_hit(next, hit);
        ASSERT_EQ(meets, inside) << "radius " << c.radius << ", " << c.from_origin
                                 << " from the origin, camera at " << c.camera_distance;
        if (inside) {
          const float chord = 2.0f * c.radius * std::abs(glm::dot(onwards, surface.normal));
          ASSERT_GT(hit.t, 0.9f * chord);
        }
        ++tested;
      }
    }
    EXPECT_GT(tested, 39000);
  }
}

TEST(Surface, SphereNormalPointsOutUnlessFlipped) {
  for (const bool flipped : {false, true}) {
    Sphere sphere;
    sphere.center = {10.0f, -20.0f, 5.0f};
    sphere.radius = 2.0f;
    sphere.flip_normals = flipped;
    Scene scene;
    add_shape(scene, sphere, diffuse(0.5f));
    const TraceScene trace(std::move(scene));
    const glm::vec3 axis = glm::normalize(glm::vec3(1.0f, 2.0f, -2.0f));
    for (const float from : {5.0f, 0.5f}) {  // from outside, from inside
      const Surface surface =
          hit_surface(trace, sphere.center + from * axis, sphere.center + 2.0f * axis);
      EXPECT_LT(glm::length(surface.normal - (flipped ? -axis : axis)), 1e-5f);
      EXPECT_EQ(surface.shading_normal, surface.normal);
      EXPECT_LT(glm::length(surface.position - (sphere.center + 2.0f * axis)), 1e-5f);
    }
  }
}

TEST(Surface, SphereUvIsAzimuthAndPolarAngleInItsOwnAxes) {
  // Mitsuba: u = φ / 2π from +x towards +y, v = θ / π from +z.
  Sphere sphere;
  sphere.center = {1.0f, 2.0f, 3.0f};
  // World x, y, z are the sphere's y, z, x.
  sphere.to_local = glm::mat3(0, 1, 0, 0, 0, 1, 1, 0, 0);
  Scene scene;
  add_shape(scene, sphere, diffuse(0.5f)).emits = true;
  scene.textures.emplace_back();
  scene.shapes[0].radiance.texture = 0;
  const TraceScene trace(std::move(scene));
  for (const auto& [u, v] : {std::pair{0.1f, 0.3f}, {0.4f, 0.5f}, {0.6f, 0.7f}, {0.9f, 0.9f}}) {
    const float phi = 2.0f * pi * u;
    const float theta = pi * v;
    const glm::vec3 local(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                          std::cos(theta));
    const glm::vec3 outward(local.y, local.z, local.x);
    const Surface surface =
        hit_surface(trace, sphere.center + 4.0f * outward, sphere.center + outward);
    EXPECT_NEAR(surface.uv.x, u, 1e-5f);
    EXPECT_NEAR(surface.uv.y, v, 1e-5f);
  }
}

TEST(Surface, DiskUvIsRadiusAndAngle) {
  for (const bool mirrored : {false, true}) {
    Disk disk;
    disk.center = {1.0f, 2.0f, 3.0f};
    disk.normal = {0.0f, 1.0f, 0.0f};
    disk.axis_u = {0.0f, 0.0f, 1.0f};
    disk.axis_v = {mirrored ? -1.0f : 1.0f, 0.0f, 0.0f};
    disk.radius = 2.0f;
    Scene scene;
    scene.textures.emplace_back();
    add_shape(scene, disk, textured_diffuse());
    const TraceScene trace(std::move(scene));
    for (const auto& [u, v] : {std::pair{0.2f, 0.1f}, {0.5f, 0.4f}, {0.7f, 0.65f}, {0.9f, 0.9f}}) {
      const float angle = 2.0f * pi * v;
      const glm::vec3 p =
          disk.center + 2.0f * u * (std::cos(angle) * disk.axis_u + std::sin(angle) * disk.axis_v);
      for (const float side : {3.0f, -3.0f}) {
        const Surface surface = hit_surface(trace, p + side * disk.normal, p);
        EXPECT_NEAR(surface.uv.x, u, 1e-5f);
        EXPECT_NEAR(surface.uv.y, v, 1e-5f);
        EXPECT_EQ(surface.normal, disk.normal);
        EXPECT_LT(glm::length(surface.position - p), 1e-5f);
      }
    }
  }
}

TEST(Surface, MeshInterpolatesUvAndNormals) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  mesh.uvs = {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.5f, 2.0f}};
  mesh.normals = {{0, 0, 1}, {1, 0, 1}, {0, 1, 2}};
  mesh.triangles = {{0, 1, 2}};
  Scene scene;
  scene.textures.emplace_back();
  add_shape(scene, mesh, textured_diffuse());
  const TraceScene trace(std::move(scene));
  const glm::vec3 p(1.0f, 2.0f, 0.0f);  // barycentrics 1/4, 1/4, 1/2
  for (const float side : {1.0f, -1.0f}) {
    const Surface surface = hit_surface(trace, p + glm::vec3(0.3f, 0.2f, side), p);
    EXPECT_LT(glm::length(surface.uv - glm::vec2(0.5f, 1.0f)), 1e-5f);
    EXPECT_EQ(surface.normal, glm::vec3(0.0f, 0.0f, 1.0f));
    const glm::vec3 expected = glm::normalize(glm::vec3(0.25f, 0.5f, 1.5f));
    EXPECT_LT(glm::length(surface.shading_normal - expected), 1e-5f);
    EXPECT_LT(glm::length(surface.position - p), 1e-5f);
  }
}

TEST(Surface, ShadingNormalsKeepToTheSideOfTheTriangle) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 4, 0}, {4, 0, 0}};  // the front looks down
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  Scene scene;
  add_shape(scene, mesh, diffuse(0.5f));
  const TraceScene trace(std::move(scene));
  const Surface surface = hit_surface(trace, {1.0f, 1.0f, 1.0f}, {1.0f, 1.0f, 0.0f});
  EXPECT_EQ(surface.normal, glm::vec3(0.0f, 0.0f, -1.0f));
  EXPECT_EQ(surface.shading_normal, glm::vec3(0.0f, 0.0f, -1.0f));
}

TEST(Surface, TriangleNormalFollowsTheRightHandRuleFromBothSides) {
  for (std::uint32_t i = 0; i < 200; ++i) {
    Sampler sampler(5, i, 0);
    std::array<float, 6> d{};
    std::copy_n(sampler.next(), 4, d.begin());
    std::copy_n(sampler.next(), 2, d.begin() + 4);
    Mesh mesh;
    mesh.positions = {direction(&d[0]), direction(&d[2]), direction(&d[4])};
    mesh.triangles = {{0, 1, 2}};
    const glm::vec3 normal =
        glm::cross(mesh.positions[1] - mesh.positions[0], mesh.positions[2] - mesh.positions[0]);
    if (glm::length(normal) < 0.01f) {
      continue;
    }
    const glm::vec3 middle =
        (mesh.positions[0] + mesh.positions[1] + mesh.positions[2]) * (1.0f / 3.0f);
    Scene scene;
    add_shape(scene, mesh, diffuse(0.5f));
    const TraceScene trace(std::move(scene));
    for (const float side : {1.0f, -1.0f}) {
      const Surface surface = hit_surface(trace, middle + side * normal, middle);
      EXPECT_GT(glm::dot(surface.normal, glm::normalize(normal)), 0.9999f);
    }
  }
}

// Through the scene reader: the fronts that Mitsuba's documentation gives its shapes.
TEST(Surface, LoadedShapesFaceTheWayOfTheirFile) {
  const std::string camera =
      "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor>"
      "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>";
  const auto shape = [&](const std::string& type, const std::string& inside) {
    return TraceScene(scene_from_xml(camera + "<shape type=\"" + type + "\">" + inside +
                                     "<bsdf type=\"diffuse\"/></shape>"));
  };
  const std::string flip = "<boolean name=\"flip_normals\" value=\"true\"/>";
  const std::string turn =
      "<transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/></transform>";
  const glm::vec3 eye(0.3f, 0.2f, 5.0f);
  const glm::vec3 spot(0.3f, 0.2f, 0.0f);
  for (const char* flat : {"rectangle", "disk"}) {
    EXPECT_EQ(hit_surface(shape(flat, ""), eye, spot).normal, glm::vec3(0.0f, 0.0f, 1.0f));
    EXPECT_EQ(hit_surface(shape(flat, flip), eye, spot).normal, glm::vec3(0.0f, 0.0f, -1.0f));
    // +z turned by 90 degrees about x looks along -y.
    const glm::vec3 turned =
        hit_surface(shape(flat, turn), {0.3f, 5.0f, 0.2f}, {0.3f, 0.0f, 0.2f}).normal;
    EXPECT_LT(glm::length(turned - glm::vec3(0.0f, -1.0f, 0.0f)), 1e-6f);
  }
  for (const char* solid : {"cube", "sphere"}) {
    const TraceScene out = shape(solid, "");
    const TraceScene in = shape(solid, flip);
    for (int axis = 0; axis < 3; ++axis) {
      for (const float sign : {1.0f, -1.0f}) {
        glm::vec3 away(0.0f);
        away[axis] = sign;
        EXPECT_LT(glm::length(hit_surface(out, 4.0f * away, {}).normal - away), 1e-6f) << solid;
        EXPECT_LT(glm::length(hit_surface(out, {}, 4.0f * away).normal - away), 1e-6f) << solid;
        EXPECT_LT(glm::length(hit_surface(in, 4.0f * away, {}).normal + away), 1e-6f) << solid;
      }
    }
  }
}

}  // namespace
}  // namespace quartet
