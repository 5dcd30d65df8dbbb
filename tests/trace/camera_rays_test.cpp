#include "renderer/trace/camera_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "renderer/base/math/warp.h"
#include "tests/trace/test_scenes.h"

namespace quartet {
namespace {

using namespace test;

Ray ray_at(const CameraRays& camera, int x, int y, float u, float v, float lens_u = 0.5f,
           float lens_v = 0.5f) {
  const Sampler::Draws draws{u, v, lens_u, lens_v};
  return camera.ray(x, y, draws);
}

Camera slanted() {
  Camera camera = pinhole({1.0f, 2.0f, 3.0f}, {4.0f, 1.0f, -2.0f}, {0.1f, 1.0f, 0.2f}, 50.0f);
  return camera;
}

void expect_near(glm::vec3 a, glm::vec3 b, float tolerance, const std::string& what) {
  EXPECT_LT(glm::length(a - b), tolerance) << what;
}

TEST(CameraRays, CornersLieAtHalfTheFieldOfView) {
  const float tangent = std::tan(glm::radians(25.0f));
  for (const auto& [width, height] : {std::pair{96, 54}, {54, 96}, {7, 7}}) {
    const float aspect = float(width) / float(height);
    const float diagonal = std::sqrt(1.0f + aspect * aspect);
    struct Case {
      FovAxis axis;
      float half_width;
    };
    for (const Case& c : {Case{FovAxis::x, tangent}, Case{FovAxis::y, tangent * aspect},
                          Case{FovAxis::smaller, aspect > 1.0f ? tangent * aspect : tangent},
                          Case{FovAxis::larger, aspect > 1.0f ? tangent : tangent * aspect},
                          Case{FovAxis::diagonal, tangent * aspect / diagonal}}) {
      Camera camera = slanted();
      camera.fov_axis = c.axis;
      const CameraRays rays(camera, width, height);
      const std::string what =
          "axis " + std::to_string(int(c.axis)) + ", width " + std::to_string(width);
      const glm::vec3 side = c.half_width * camera.right;
      const glm::vec3 top = c.half_width / aspect * camera.up;
      const auto corner = [&](float x, float y) {
        return glm::normalize(camera.forward + x * side + y * top);
      };
      // Pixel (0, 0) is the top left one; draws of 0 and 1 are its corners.
      expect_near(ray_at(rays, 0, 0, 0, 0).direction, corner(-1, 1), 1e-6f, what);
      expect_near(ray_at(rays, width - 1, 0, 1, 0).direction, corner(1, 1), 1e-6f, what);
      expect_near(ray_at(rays, 0, height - 1, 0, 1).direction, corner(-1, -1), 1e-6f, what);
      expect_near(ray_at(rays, width - 1, height - 1, 1, 1).direction, corner(1, -1), 1e-6f, what);
      EXPECT_EQ(ray_at(rays, 3, 2, 0.1f, 0.7f).origin, camera.origin);
    }
  }
}

TEST(CameraRays, PixelsShareTheirEdges) {
  const CameraRays rays(slanted(), 40, 30);
  expect_near(ray_at(rays, 11, 7, 1, 0.3f).direction, ray_at(rays, 12, 7, 0, 0.3f).direction, 1e-6f,
              "to the right");
  expect_near(ray_at(rays, 11, 7, 0.3f, 1).direction, ray_at(rays, 11, 8, 0.3f, 0).direction, 1e-6f,
              "down");
}

TEST(CameraRays, AllRaysThroughTheLensMeetInFocus) {
  Camera camera = slanted();
  const CameraRays through_pinhole(camera, 40, 30);
  camera.aperture_radius = 0.25f;
  camera.focus_distance = 6.5f;
  const CameraRays rays(camera, 40, 30);
  float widest = 0.0f;
  for (const auto& [x, y] : {std::pair{0, 0}, {39, 29}, {20, 15}, {5, 28}}) {
    const glm::vec3 pinhole_way = ray_at(through_pinhole, x, y, 0.4f, 0.6f).direction;
    const glm::vec3 focus =
        camera.origin + pinhole_way * (6.5f / glm::dot(pinhole_way, camera.forward));
    for (float u = 0.0f; u < 1.0f; u += 0.09f) {
      for (float v = 0.0f; v < 1.0f; v += 0.09f) {
        const Ray ray = ray_at(rays, x, y, 0.4f, 0.6f, u, v);
        const glm::vec3 shift = ray.origin - camera.origin;
        widest = std::max(widest, glm::length(shift));
        EXPECT_NEAR(glm::dot(shift, camera.forward), 0.0f, 1e-6f);
        EXPECT_NEAR(glm::length(ray.direction), 1.0f, 1e-6f);
        expect_near(ray.origin + ray.direction * (6.5f / glm::dot(ray.direction, camera.forward)),
                    focus, 1e-5f, "lens point " + std::to_string(u) + ", " + std::to_string(v));
      }
    }
  }
  EXPECT_LT(widest, 0.25f + 1e-6f);
  EXPECT_GT(widest, 0.24f);
}

TEST(CameraRays, LensPointsAreEvenOverItsArea) {
  // The mean of r² over a disk is R² / 2, and of x and y it is 0.
  Camera camera = slanted();
  camera.aperture_radius = 2.0f;
  const CameraRays rays(camera, 1, 1);
  glm::dvec3 mean(0.0);
  double square = 0.0;
  constexpr int steps = 100;
  for (int i = 0; i < steps * steps; ++i) {
    const Ray ray = ray_at(rays, 0, 0, 0.5f, 0.5f, (float(i % steps) + 0.5f) / steps,
                           (float(i) / steps + 0.0f) / steps);
    const glm::dvec3 shift(ray.origin - camera.origin);
    mean += shift / double(steps * steps);
    square += glm::dot(shift, shift) / double(steps * steps);
  }
  EXPECT_LT(glm::length(mean), 0.02);
  EXPECT_NEAR(square, 2.0, 0.02);
}

TEST(CameraRays, ALoadedCameraLooksAtItsTargetWithTheRightHandednessOfMitsuba) {
  const Scene scene = scene_from_xml(
      "<sensor type=\"perspective\"><float name=\"fov\" value=\"90\"/>"
      "<transform name=\"to_world\"><lookat origin=\"0,0,-5\" target=\"0,0,0\" up=\"0,1,0\"/>"
      "</transform><film type=\"hdrfilm\"><integer name=\"width\" value=\"2\"/>"
      "<integer name=\"height\" value=\"2\"/></film></sensor>"
      "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>"
      "<shape type=\"sphere\"/>");
  const RenderSettings settings = default_settings(scene);
  const CameraRays rays(settings.camera, settings.width, settings.height);
  // Looking along +z with +y up, +x is on the left.
  const glm::vec3 top_left = glm::normalize(glm::vec3(1.0f, 1.0f, 1.0f));
  expect_near(ray_at(rays, 0, 0, 0, 0).direction, top_left, 1e-6f, "top left");
  EXPECT_EQ(ray_at(rays, 0, 0, 0, 0).origin, glm::vec3(0.0f, 0.0f, -5.0f));
}

}  // namespace
}  // namespace quartet
