#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <vector>

#include "renderer/trace/integrator.h"
#include "tests/trace/test_scenes.h"

namespace quartet {
namespace {

using namespace test;

constexpr float albedo = 0.6f;

Scene floor_scene() {
  Scene scene;
  add_shape(scene, parallelogram({-200, 0, 200}, {400, 0, 0}, {0, 0, -400}), diffuse(albedo));
  return scene;
}

/// Looks at the origin, from the side and below all lights.
RenderSettings settings_of(IntegratorId integrator, int max_depth) {
  return {.camera = pinhole({0.0f, 0.2f, 0.4f}, {}, {0, 1, 0}),
          .width = 1,
          .height = 1,
          .max_depth = max_depth,
          .integrator = integrator,
          .seed = 100};
}

std::vector<glm::vec3> samples_of(const Scene& scene, const RenderSettings& settings) {
  const TraceScene trace(scene);
  const CameraRays camera(settings.camera, 1, 1);
  std::vector<glm::vec3> samples(256);
  integrator(settings.integrator).trace(trace, settings, camera, 0, 0, 0, samples);
  return samples;
}

/// What a point of intensity 1 makes of the floor at the origin: ρ/π · cos θ / d².
double reflected(glm::vec3 light) {
  const double distance = double(glm::length(light));
  return double(albedo) / std::numbers::pi * double(light.y) / (distance * distance * distance);
}

TEST(PointLight, IlluminatesWithCosineOverDistanceSquared) {
  // Each path says exactly that, nothing about it is random, and longer ones find no more.
  const glm::vec3 intensity(3.0f, 2.0f, 1.0f);
  for (const glm::vec3 light : {glm::vec3(0, 2, 0), {1.5f, 0.7f, -2}, {-30, 4, 10}}) {
    Scene scene = floor_scene();
    scene.delta_lights.push_back(PointLight{light, intensity});
    for (const int max_depth : {2, 3, std::numeric_limits<int>::max()}) {
      for (const glm::vec3& sample : samples_of(scene, settings_of(IntegratorId::mis, max_depth))) {
        for (int channel = 0; channel < 3; ++channel) {
          EXPECT_NEAR(double(sample[channel]), double(intensity[channel]) * reflected(light),
                      1e-3 * reflected(light));
        }
      }
    }
    // No ray meets it, and a direct look at it is none.
    for (const glm::vec3& sample : samples_of(scene, settings_of(IntegratorId::mis, 1))) {
      EXPECT_EQ(sample, glm::vec3(0.0f));
    }
    for (const glm::vec3& sample :
         samples_of(scene, settings_of(IntegratorId::kajiya, std::numeric_limits<int>::max()))) {
      EXPECT_EQ(sample, glm::vec3(0.0f));
    }
  }
}

TEST(PointLight, IsHiddenByWhatLiesBeforeItOnly) {
  const glm::vec3 light(1.0f, 3.0f, -1.0f);
  for (const float along : {0.5f, 0.999f, 1.001f, 1.5f}) {
    Scene scene = floor_scene();
    scene.delta_lights.push_back(PointLight{light, glm::vec3(1.0f)});
    add_shape(
        scene,
        parallelogram(along * light - glm::vec3(0.1f, 0.0f, 0.1f), {0.2f, 0, 0}, {0, 0, 0.2f}),
        diffuse(0.0f));
    for (const glm::vec3& sample : samples_of(scene, settings_of(IntegratorId::mis, 2))) {
      EXPECT_NEAR(double(sample.x), along < 1.0f ? 0.0 : reflected(light), 1e-3 * reflected(light));
    }
  }
}

TEST(PointLight, SharesSamplesWithOtherLightsByPower) {
  // Two points, of which each is chosen for part of the samples: a sample is worth what its light
  // gives over that part.
  const glm::vec3 near(0.5f, 1.0f, 0.0f);
  const glm::vec3 far(-4.0f, 6.0f, 2.0f);
  Scene scene = floor_scene();
  scene.delta_lights.push_back(PointLight{near, glm::vec3(1.0f)});
  scene.delta_lights.push_back(PointLight{far, glm::vec3(3.0f)});
  int of_near = 0;
  for (const glm::vec3& sample : samples_of(scene, settings_of(IntegratorId::mis, 2))) {
    const bool is_near = std::abs(double(sample.x) / (reflected(near) / 0.25) - 1.0) < 1e-3;
    of_near += is_near;
    if (!is_near) {
      EXPECT_NEAR(double(sample.x), 3.0 * reflected(far) / 0.75, 1e-3 * reflected(far));
    }
  }
  // A quarter of 256 stratified samples, exactly.
  EXPECT_EQ(of_near, 64);
}

}  // namespace
}  // namespace quartet
