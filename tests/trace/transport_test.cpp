#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "renderer/trace/integrator.h"
#include "renderer/trace/path.h"
#include "tests/trace/statistics.h"
#include "tests/trace/test_scenes.h"

// Both integrators against closed forms. Each test is a z-test of batch means at a false-alarm rate
// of 1e-3 over all its measurements. 64 batches of hundreds of samples are normal enough for that:
// the standard error is known to 9 %.

namespace quartet {
namespace {

using namespace test;

class Expectations {
 public:
  void add(const std::string& name, const Moments& measured, double truth) {
    rows_.push_back({name, measured.mean(), measured.standard_error(), truth});
  }

  ~Expectations() {
    const double level = sidak_level(1e-3, double(rows_.size()));
    for (const Row& row : rows_) {
      // Where all samples are alike only rounding is left.
      const double error = std::max(row.error, 2e-6 * row.truth);
      EXPECT_GE(two_sided_p((row.mean - row.truth) / error), level)
          << row.name << ": " << row.mean << " ± " << row.error << ", expected " << row.truth;
      EXPECT_LT(row.error, 0.02 * row.truth) << row.name << ": too noisy to show anything";
    }
  }

 private:
  struct Row {
    std::string name;
    double mean, error, truth;
  };
  std::vector<Row> rows_;
};

constexpr int transport_batches = 64;

RenderSettings one_pixel(const Camera& camera, IntegratorId integrator, int max_depth) {
  return {.camera = camera,
          .width = 1,
          .height = 1,
          .max_depth = max_depth,
          .integrator = integrator,
          .seed = 100};
}

constexpr int unlimited = std::numeric_limits<int>::max();

TEST(Transport, FurnaceOfEveryAlbedoAndDepth) {
  Expectations expectations;
  for (const std::string albedo : {"0.5", "0.8", "0.95"}) {
    const TraceScene scene(load_scene(find_scene("furnace"), {{"albedo", albedo}}));
    const double a = std::stod(albedo);
    for (const Integrator& row : integrators()) {
      RenderSettings settings = default_settings(scene.scene());
      ASSERT_EQ(settings.max_depth, unlimited);
      settings.integrator = row.key;
      const std::string name = std::string(row.id) + ", albedo " + albedo;
      for (const auto& [x, y] : {std::pair{3, 5}, {32, 40}}) {
        expectations.add(name, measure(scene, settings, x, y, transport_batches, 800),
                         1.0 / (1.0 - a));
      }
      double truth = 0.0;
      for (int depth = 1; depth <= 6; ++depth) {
        truth += std::pow(a, depth - 1);
        settings.max_depth = depth;
        expectations.add(name + ", depth " + std::to_string(depth),
                         measure(scene, settings, 10, 10, transport_batches, 200), truth);
      }
    }
  }
}

TEST(Transport, WithoutRoulettePathsGoOnToTheirDepth) {
  const TraceScene scene(load_scene(find_scene("furnace"), {{"albedo", "0.5"}}));
  for (const Integrator& row : integrators()) {
    RenderSettings settings = default_settings(scene.scene());
    settings.integrator = row.key;
    settings.max_depth = 12;
    settings.roulette = false;
    const CameraRays camera(settings.camera, settings.width, settings.height);
    std::vector<glm::vec3> radiance(64);
    std::vector<std::uint16_t> rays(64);
    SampleJob job{20, 20, 0, radiance, rays};
    row.trace_jobs(scene, settings, camera, {&job, 1});
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      // Where every surface shines alike, a path that cannot end early has no noise.
      if (row.key == IntegratorId::kajiya) {
        EXPECT_EQ(rays[i], 12);
        EXPECT_NEAR(radiance[i].y, 2.0f - std::pow(0.5f, 11.0f), 1e-5f);
      } else {
        EXPECT_EQ(rays[i], 12 + 11) << "a light sample at all but the last vertex";
      }
    }
  }
}

/// Irradiance at `point` with unit `normal` from a polygon of radiance 1 that lies wholly above:
/// Lambert 1760; half the sum over the edges of their angle times the cosine of their plane.
double lambert(const std::vector<glm::dvec3>& polygon, glm::dvec3 point, glm::dvec3 normal) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = glm::normalize(polygon[i] - point);
    const glm::dvec3 b = glm::normalize(polygon[(i + 1) % polygon.size()] - point);
    const glm::dvec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(across / sine, normal);
  }
  return 0.5 * std::abs(sum);
}

/// A wide floor of the given albedo at height 0.
void add_floor(Scene& scene, float albedo, float half_size = 200.0f) {
  add_shape(scene,
            parallelogram({-half_size, 0.0f, half_size}, {2.0f * half_size, 0.0f, 0.0f},
                          {0.0f, 0.0f, -2.0f * half_size}),
            diffuse(albedo));
}

/// Looks at a point of the floor from the side, below all lights.
Camera at_floor(glm::vec3 point) {
  return pinhole(point + glm::vec3(0.0f, 0.2f, 0.4f), point, {0.0f, 1.0f, 0.0f});
}

TEST(Transport, PolygonLightAgainstLambert) {
  struct Case {
    std::string name;
    std::vector<glm::vec3> corners;  // in the order that makes the front look down
    glm::vec3 point;
    bool by_chance;  // large enough to be found by BSDF sampling alone
  };
  const std::vector<glm::vec3> above{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}};
  const std::vector<Case> cases{
      {"above", above, {0, 0, 0}, true},
      {"aside", above, {1.5f, 0, -0.7f}, true},
      {"far aside, at a grazing angle", above, {25, 0, 10}, false},
      {"further aside", above, {-90, 0, 30}, false},
      {"small", {{2, 3, 2}, {2.1f, 3, 2}, {2.1f, 3, 2.1f}, {2, 3, 2.1f}}, {1, 0, 1}, false},
      {"slanted", {{1, 1, 2}, {2, 3, 2}, {2, 3, -1}, {1, 1, -1}}, {-1, 0, 0.5f}, true},
      {"triangle", {{-1, 1, -1}, {2, 2, 0}, {0, 1, 1}}, {0.3f, 0, 0.2f}, true},
  };
  Expectations expectations;
  for (const Case& c : cases) {
    Scene scene;
    add_floor(scene, 0.6f);
    Mesh light;
    light.positions = c.corners;
    light.triangles = {{0, 1, 2}};
    if (c.corners.size() == 4) {
      light.triangles.push_back({0, 2, 3});
    }
    std::vector<glm::dvec3> polygon(c.corners.begin(), c.corners.end());
    const double truth = 0.6 / std::numbers::pi * 5.0 * lambert(polygon, c.point, {0.0, 1.0, 0.0});
    for (const bool parallelogram : {false, true}) {
      if (parallelogram && c.corners.size() != 4) {
        continue;
      }
      light.parallelogram = parallelogram;
      Scene with_light = scene;
      add_light(with_light, light, 5.0f);
      const TraceScene trace(std::move(with_light));
      for (const Integrator& row : integrators()) {
        if (row.key == IntegratorId::kajiya && !c.by_chance) {
          continue;
        }
        expectations.add(
            std::string(row.id) + ", " + c.name + (parallelogram ? ", parallelogram" : ""),
            measure(trace, one_pixel(at_floor(c.point), row.key, 2), 0, 0, transport_batches, 500),
            truth);
      }
    }
  }
}

TEST(Transport, SphereLightAbovePlane) {
  struct Case {
    glm::vec3 center;
    float radius;
    bool by_chance;
  };
  Expectations expectations;
  for (const Case& c : {Case{{0, 2, 0}, 1.0f, true}, Case{{2, 2, 1}, 1.5f, true},
                        Case{{0.3f, 1.02f, 0.1f}, 1.0f, true}, Case{{-3, 4, 2}, 0.3f, false},
                        Case{{6, 5, -3}, 0.01f, false}, Case{{60, 12, -3}, 2.0f, false}}) {
    Scene scene;
    add_floor(scene, 0.6f);
    Sphere sphere;
    sphere.center = c.center;
    sphere.radius = c.radius;
    add_light(scene, sphere, 5.0f);
    const TraceScene trace(std::move(scene));
    const double distance = double(glm::length(c.center));
    const double ratio = double(c.radius) / distance;
    const double truth = 0.6 * 5.0 * ratio * ratio * double(c.center.y) / distance;
    for (const Integrator& row : integrators()) {
      if (row.key == IntegratorId::kajiya && !c.by_chance) {
        continue;
      }
      // The camera is so close that no light stands in its way.
      const Camera camera = pinhole({0.0f, 0.005f, 0.01f}, {}, {0.0f, 1.0f, 0.0f});
      expectations.add(std::string(row.id) + ", radius " + std::to_string(c.radius) + " at " +
                           std::to_string(distance),
                       measure(trace, one_pixel(camera, row.key, 2), 0, 0, transport_batches, 500),
                       truth);
    }
  }
}

TEST(Transport, DiskLightAboveItsCentre) {
  // E = π L R² / (R² + h²)
  Scene scene;
  add_floor(scene, 0.6f);
  Disk disk;
  disk.center = {0.0f, 1.5f, 0.0f};
  disk.normal = {0.0f, -1.0f, 0.0f};
  disk.axis_v = {0.0f, 0.0f, 1.0f};
  disk.radius = 0.8f;
  add_light(scene, disk, 5.0f);
  const TraceScene trace(std::move(scene));
  Expectations expectations;
  for (const Integrator& row : integrators()) {
    expectations.add(
        std::string(row.id),
        measure(trace, one_pixel(at_floor({}), row.key, 2), 0, 0, transport_batches, 500),
        0.6 * 5.0 * 0.64 / (0.64 + 2.25));
  }
}

TEST(Transport, EnvironmentAloneAndBesideALight) {
  Expectations expectations;
  for (const bool beside : {false, true}) {
    Scene scene;
    add_floor(scene, 0.6f);
    scene.environment = ConstantEnvironment{glm::vec3(2.0f)};
    const glm::vec3 corner(-1.0f, 1.0f, -1.0f);
    double truth = 0.6 * 2.0;
    if (beside) {
      add_light(scene, parallelogram(corner, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 2.0f}), 5.0f);
      const std::vector<glm::dvec3> polygon{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}};
      // The light hides the environment behind it.
      truth += 0.6 / std::numbers::pi * (5.0 - 2.0) * lambert(polygon, {}, {0.0, 1.0, 0.0});
    }
    const TraceScene trace(std::move(scene));
    for (const Integrator& row : integrators()) {
      const std::string name = std::string(row.id) + (beside ? ", beside a light" : "");
      expectations.add(
          name, measure(trace, one_pixel(at_floor({}), row.key, 2), 0, 0, transport_batches, 500),
          truth);
      Camera up = at_floor({});
      up.forward = {0.8f, 0.6f, 0.0f};
      up.right = {0.0f, 0.0f, 1.0f};
      up.up = {-0.6f, 0.8f, 0.0f};
      up.origin.y = 3.0f;
      expectations.add(name + ", seen itself",
                       measure(trace, one_pixel(up, row.key, 1), 0, 0, transport_batches, 2), 2.0);
    }
  }
}

/// What a path is worth that met only perfect glass and an environment of 1: as many divisions by
/// the survival of Russian roulette as there were roulettes; or nothing, if one ended it.
bool is_power_of_survival(float value) {
  const double power = -std::log(double(value)) / std::log(double(detail::max_survival));
  return value == 0.0f || std::abs(power - std::round(power)) < 1e-3;
}

TEST(Transport, PerfectGlassIsInvisibleInAConstantEnvironment) {
  Expectations expectations;
  Scene ball;
  ball.environment = ConstantEnvironment{glm::vec3(1.0f)};
  add_shape(ball, Sphere{}, glass(1.5f));
  Scene slab;
  slab.environment = ConstantEnvironment{glm::vec3(1.0f)};
  const float w = 50.0f;
  add_shape(slab, parallelogram({-w, -w, 1.0f}, {2 * w, 0, 0}, {0, 2 * w, 0}), glass(1.5f));
  add_shape(slab, parallelogram({-w, -w, 0.5f}, {0, 2 * w, 0}, {2 * w, 0, 0}), glass(1.5f));
  for (Scene* scene : {&ball, &slab}) {
    const TraceScene trace(*scene);
    for (const Integrator& row : integrators()) {
      for (const glm::vec3 aim :
           {glm::vec3(0.0f), glm::vec3(0.5f, 0.3f, 0.0f), glm::vec3(0.9f, 0.3f, 0.0f)}) {
        RenderSettings settings =
            one_pixel(pinhole({0.0f, 0.0f, 6.0f}, aim, {0.0f, 1.0f, 0.0f}), row.key, unlimited);
        expectations.add(std::string(row.id) + (scene == &ball ? ", ball" : ", slab"),
                         measure(trace, settings, 0, 0, transport_batches, 500), 1.0);
        std::vector<glm::vec3> samples(1000);
        const CameraRays camera(settings.camera, 1, 1);
        row.trace(trace, settings, camera, 0, 0, 0, samples);
        for (const glm::vec3& sample : samples) {
          ASSERT_TRUE(is_power_of_survival(sample.y)) << sample.y;
        }
      }
    }
  }
}

TEST(Transport, RadianceInsideGlassGrowsWithTheSquareOfItsIndex) {
  Scene ball;
  ball.environment = ConstantEnvironment{glm::vec3(1.0f)};
  add_shape(ball, Sphere{}, glass(1.5f));
  const TraceScene trace(std::move(ball));
  Expectations expectations;
  for (const Integrator& row : integrators()) {
    // Near the critical angle, where half the light stays inside at each bounce.
    const Camera camera = pinhole({0.66f, 0.0f, 0.0f}, {0.66f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.0f});
    expectations.add(
        std::string(row.id),
        measure(trace, one_pixel(camera, row.key, unlimited), 0, 0, transport_batches, 500), 2.25);
  }
}

TEST(Transport, AFloorSeenThroughGlassKeepsItsBrightness) {
  // A lit white floor inside a furnace of white walls and the ball before it all stay at 1.
  Scene scene;
  Sphere around;
  around.radius = 10.0f;
  around.flip_normals = true;
  add_light(scene, around, 0.5f);
  scene.materials.back() = diffuse(0.5f);
  add_shape(scene, Sphere{}, glass(1.5f));
  Sphere mirror;
  mirror.center = {3.0f, 1.0f, 0.0f};
  add_shape(scene, mirror, perfect_mirror());
  const TraceScene trace(std::move(scene));
  Expectations expectations;
  for (const Integrator& row : integrators()) {
    for (const glm::vec3 aim : {glm::vec3(0.3f, 0.2f, 0.0f), mirror.center, glm::vec3(1, -9, 0)}) {
      const Camera camera = pinhole({0.0f, 0.0f, 6.0f}, aim, {0.0f, 1.0f, 0.0f});
      expectations.add(
          std::string(row.id),
          measure(trace, one_pixel(camera, row.key, unlimited), 0, 0, transport_batches, 500), 1.0);
    }
  }
}

TEST(Transport, DepthCountsTheSegmentsOfAPath) {
  // A floor under an environment of 1, seen in a mirror: the mirror is one segment away, the floor
  // two, its light three.
  Scene scene;
  add_floor(scene, 0.6f);
  add_shape(scene, parallelogram({-1.0f, 0.5f, -1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f}),
            perfect_mirror());
  add_light(scene, parallelogram({-50, 80, -50}, {100, 0, 0}, {0, 0, 100}), 1.0f);
  const TraceScene trace(std::move(scene));
  const Camera camera = pinhole({0.0f, 3.0f, 1.0f}, {0.0f, 1.2f, -1.0f}, {0.0f, 1.0f, 0.0f}, 0.01f);
  for (const Integrator& row : integrators()) {
    for (int depth = 1; depth <= 3; ++depth) {
      const Moments seen =
          measure(trace, one_pixel(camera, row.key, depth), 0, 0, transport_batches, 20);
      if (depth < 3) {
        EXPECT_EQ(seen.mean(), 0.0) << row.id << ", depth " << depth;
      } else {
        EXPECT_GT(seen.mean(), 0.1) << row.id << ", depth " << depth;
      }
    }
  }
}

TEST(Transport, ASampleDependsOnNothingButItsAddress) {
  const TraceScene scene(load_scene(find_scene("cornell-checker")));
  RenderSettings settings = default_settings(scene.scene());
  settings.width = 48;
  settings.height = 27;
  const CameraRays camera(settings.camera, settings.width, settings.height);
  for (const Integrator& row : integrators()) {
    std::vector<glm::vec3> all(16);
    row.trace(scene, settings, camera, 20, 13, 0, all);
    for (std::uint32_t i = 0; i < 16; ++i) {
      std::vector<glm::vec3> one(1);
      row.trace(scene, settings, camera, 20, 13, i, one);
      EXPECT_EQ(one[0], all[i]);
    }
    settings.seed = 1;
    std::vector<glm::vec3> other(16);
    row.trace(scene, settings, camera, 20, 13, 0, other);
    EXPECT_NE(other, all);
    settings.seed = 0;
  }
}

TEST(Transport, UnknownIntegratorsListTheLegalOnes) {
  EXPECT_EQ(&find_integrator("mis"), &integrator(IntegratorId::mis));
  try {
    find_integrator("bdpt");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("kajiya, mis"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace quartet
