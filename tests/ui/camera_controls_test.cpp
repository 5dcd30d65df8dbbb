#include "ui/widgets/camera_controls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/scene/limits.h"

namespace quartet {
namespace {

/// A camera at a distance from a pivot, looking at it.
CameraControls controls_at(glm::vec3 pivot, float distance) {
  Camera home;
  home.forward = glm::vec3(0.0f, 0.0f, -1.0f);
  home.right = glm::vec3(1.0f, 0.0f, 0.0f);
  home.up = glm::vec3(0.0f, 1.0f, 0.0f);
  home.origin = pivot - distance * home.forward;
  home.focus_distance = distance;
  return {home, pivot};
}

float distance_of(const CameraControls& controls, const Camera& camera) {
  return float(glm::length(glm::dvec3(camera.origin) - glm::dvec3(controls.pivot)));
}

// Of scenes as small and as large as there may be, at the origin and far from it.
const CameraControls cases[] = {
    controls_at({0, 0, 0}, 5.0f),      controls_at({0, 0, 0}, 3e-9f),
    controls_at({0, 0, 0}, 9e8f),      controls_at({9e8f, 0, 0}, 1e8f),
    controls_at({100, 100, 0}, 0.01f),
};

TEST(CameraControls, GoesNearerAndFartherAsAsked) {
  for (const CameraControls& controls : cases) {
    SCOPED_TRACE(distance_of(controls, controls.home));
    const float home = distance_of(controls, controls.home);
    EXPECT_LT(distance_of(controls, dolly(controls, controls.home, 1.0f)), home);
    EXPECT_LE(distance_of(controls, controls.home),
              distance_of(controls, dolly(controls, controls.home, -0.01f)));
  }
  const Camera nearer = dolly(cases[0], cases[0].home, 10.0f);
  EXPECT_NEAR(distance_of(cases[0], nearer), 5.0f * std::exp(-1.1f), 1e-5f);
  EXPECT_NEAR(distance_of(cases[0], dolly(cases[0], nearer, -10.0f)), 5.0f, 1e-5f);
}

TEST(CameraControls, NoNumberOfStepsLeadsBeyondWhatCanBeTracedAndTheWayBackIsOpen) {
  for (const CameraControls& controls : cases) {
    SCOPED_TRACE(distance_of(controls, controls.home));
    for (const float step : {1.0f, -1.0f, 1e30f, -1e30f}) {
      Camera camera = controls.home;
      for (int i = 0; i < 3000; ++i) {
        camera = dolly(controls, camera, step);
        ASSERT_EQ(camera_fault(camera), "") << "after " << i << " steps of " << step;
      }
      const float end = distance_of(controls, camera);
      EXPECT_GT(end, 0.0f);
      for (int i = 0; i < 20; ++i) {
        camera = dolly(controls, camera, step > 0.0f ? -1.0f : 1.0f);
      }
      EXPECT_EQ(distance_of(controls, camera) > end, step > 0.0f);
    }
  }
}

TEST(CameraControls, TheEndsOfTheWayAreAsTheyAreStated) {
  const CameraControls& controls = cases[0];
  EXPECT_NEAR(distance_of(controls, dolly(controls, controls.home, 1e6f)), 5e-4f, 1e-8f);
  EXPECT_NEAR(distance_of(controls, dolly(controls, controls.home, -1e6f)), 5e4f, 0.1f);
}

TEST(CameraControls, TurnsKeepTheAxesAtRightAnglesAndTheDistance) {
  for (const CameraControls& controls : cases) {
    SCOPED_TRACE(distance_of(controls, controls.home));
    std::mt19937 random(5);
    std::uniform_real_distribution<float> angle(-0.3f, 0.3f);
    Camera camera = controls.home;
    for (int i = 0; i < 20'000; ++i) {
      camera = orbit(controls, camera, angle(random), angle(random));
    }
    ASSERT_EQ(camera_fault(camera), "");
    EXPECT_NEAR(glm::dot(camera.right, camera.up), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(camera.up, camera.forward), 0.0f, 1e-5f);
  }
  const Camera turned = orbit(cases[0], cases[0].home, 1e6f, -1e6f);
  EXPECT_EQ(camera_fault(turned), "");
  EXPECT_NEAR(distance_of(cases[0], turned), 5.0f, 1e-4f);
}

TEST(CameraControls, ACameraOnItsPivotCanLeaveIt) {
  CameraControls controls = cases[0];
  Camera camera = controls.home;
  camera.origin = controls.pivot;
  camera = orbit(controls, dolly(controls, camera, -1.0f), 0.1f, 0.1f);
  EXPECT_EQ(camera_fault(camera), "");
  EXPECT_GT(distance_of(controls, camera), 0.0f);
}

}  // namespace
}  // namespace quartet
