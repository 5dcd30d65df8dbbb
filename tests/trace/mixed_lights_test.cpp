#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "renderer/trace/path.h"
#include "renderer/trace/path_log.h"
#include "tests/trace/statistics.h"
#include "tests/trace/test_scenes.h"

// Lights of several kinds side by side: whichever way a path finds one, its density holds the
// chance of having chosen it among the others, and its weight is the power heuristic's.

namespace quartet {
namespace {

using namespace test;

Sphere ball(glm::vec3 center, float radius) {
  Sphere sphere;
  sphere.center = center;
  sphere.radius = radius;
  return sphere;
}

Disk disk_facing_down(glm::vec3 center, float radius) {
  Disk disk;
  disk.center = center;
  disk.normal = {0, -1, 0};
  disk.axis_v = {0, 0, 1};
  disk.radius = radius;
  return disk;
}

Mesh triangles_facing_down(glm::vec3 corner) {
  Mesh mesh;
  mesh.positions = {corner, corner + glm::vec3(1, 0.2f, 0), corner + glm::vec3(1, 0, 1),
                    corner + glm::vec3(0, 0.1f, 1.2f)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Faces down, like all flat lights here.
void add_panel(Scene& scene, glm::vec3 corner, float size, float radiance) {
  add_light(scene, parallelogram(corner, {size, 0, 0}, {0, 0, size}), radiance);
}

Material rough_metal(float alpha = 0.1f) {
  Material material;
  material.kind = RoughConductor{{.reflectance = {glm::vec3(0.9f)}}, alpha};
  material.two_sided = true;
  return material;
}

/// A floor, with lights above it.
struct LitCase {
  std::string name;
  std::function<void(Scene&)> light;
};

std::vector<LitCase> lit_cases() {
  const auto panel = [](Scene& s) { add_panel(s, {-1, 1.5f, -1}, 2.0f, 2.0f); };
  return {
      {"panel and environment",
       [=](Scene& s) {
         panel(s);
         s.environment = ConstantEnvironment{glm::vec3(0.5f)};
       }},
      {"ball and environment",
       [](Scene& s) {
         add_light(s, ball({0.5f, 1.5f, 0.2f}, 0.7f), 4.0f);
         s.environment = ConstantEnvironment{glm::vec3(0.6f)};
       }},
      {"triangles, disk and environment",
       [](Scene& s) {
         add_light(s, triangles_facing_down({-1.5f, 1.2f, -0.5f}), 4.0f);
         add_light(s, disk_facing_down({1, 1.4f, 0}, 0.6f), 5.0f);
         s.environment = ConstantEnvironment{glm::vec3(0.3f)};
       }},
      {"several of each",
       [=](Scene& s) {
         panel(s);
         add_panel(s, {1.2f, 1.0f, -1}, 0.8f, 3.0f);
         add_light(s, ball({-1.6f, 0.9f, 0.3f}, 0.4f), 3.0f);
         add_light(s, ball({0, 0.8f, 1.6f}, 0.5f), 2.0f);
         add_light(s, triangles_facing_down({-2.5f, 1.6f, -2.5f}), 5.0f);
         add_light(s, triangles_facing_down({1.5f, 1.6f, 1}), 5.0f);
         add_light(s, disk_facing_down({0.3f, 1.1f, -2}, 0.6f), 4.0f);
         add_light(s, disk_facing_down({-1.2f, 1.3f, 1.5f}, 0.4f), 6.0f);
         s.environment = ConstantEnvironment{glm::vec3(0.4f)};
       }},
  };
}

TraceScene lit_floor(const LitCase& c, const Material& floor) {
  Scene scene;
  add_shape(scene, parallelogram({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), floor);
  c.light(scene);
  return TraceScene(std::move(scene));
}

/// Looks at the middle of the floor.
RenderSettings one_point(IntegratorId id, int max_depth) {
  RenderSettings settings;
  settings.camera = pinhole({0.4f, 0.6f, 0.5f}, {0, 0, 0}, {0, 1, 0});
  settings.width = settings.height = 1;
  settings.integrator = id;
  settings.max_depth = max_depth;
  return settings;
}

// Means of 64 batches, each with a seed of its own, are compared by Student's t at a false-alarm
// rate of 1e-3 over all; what is as dim as a forgotten chance makes it must be noticed.
TEST(MixedLights, BothIntegratorsAgree) {
  constexpr int batches = 64;
  const std::vector<LitCase> all = lit_cases();
  const double level = sidak_level(1e-3, 4.0 * double(all.size()));
  for (const LitCase& c : all) {
    for (const bool rough : {false, true}) {
      const TraceScene scene = lit_floor(c, rough ? rough_metal() : diffuse(0.7f));
      for (const int max_depth : {2, 4}) {
        SCOPED_TRACE(c.name + (rough ? ", rough metal, depth " : ", diffuse, depth ") +
                     std::to_string(max_depth));
        RenderSettings settings = one_point(IntegratorId::kajiya, max_depth);
        settings.seed = 1000;
        const Moments kajiya = measure(scene, settings, 0, 0, batches, 1024);
        settings = one_point(IntegratorId::mis, max_depth);
        settings.seed = 2000;
        const Moments mis = measure(scene, settings, 0, 0, batches, 512);
        const double error = std::sqrt(kajiya.variance_of_mean() + mis.variance_of_mean());
        const double t = (mis.mean() - kajiya.mean()) / error;
        EXPECT_GE(two_sided_student_p(t, batches - 1), level)
            << kajiya.mean() << " and " << mis.mean() << " ± " << error;
        EXPECT_LT(two_sided_student_p(0.03 * kajiya.mean() / error, batches - 1), level)
            << "3 % must be noticed";
      }
    }
  }
}

// What a sample of a light says of its density is what the way by a surface's BSDF weighs with.
TEST(MixedLights, DensitiesOfBothWaysAreTheSame) {
  const glm::vec3 from(0.1f, 0.01f, 0.2f);
  for (const LitCase& c : lit_cases()) {
    SCOPED_TRACE(c.name);
    const TraceScene scene = lit_floor(c, diffuse(0.5f));
    int environment = 0;
    int shapes = 0;
    for (std::uint32_t i = 0; i < 4000; ++i) {
      Sampler sampler(1, i, 0);
      const Sampler::Draws& draws = sampler.next();
      const LightSample s = scene.lights().sample(from, draws[0], draws[1]);
      if (s.radiance == glm::vec3(0.0f) ||
          scene.accel().occluded({from, s.direction, s.distance})) {
        continue;
      }
      const Ray ray{from, s.direction};
      Hit hit{};
      if (std::isinf(s.distance)) {
        ASSERT_FALSE(scene.accel().closest_hit(ray, hit));
        ASSERT_NEAR(double(scene.lights().environment_pdf()) / double(s.pdf), 1.0, 1e-5);
        ++environment;
      } else if (scene.accel().closest_hit(ray, hit) && scene.emits(hit.shape)) {
        const double pdf =
            double(scene.lights().pdf(scene.surface(ray, hit), from, s.direction, hit.t));
        ASSERT_NEAR(pdf / double(s.pdf), 1.0, 5e-3);
        ++shapes;
      }
    }
    EXPECT_GT(environment, 100);
    EXPECT_GT(shapes, 100);
  }
}

// Veach 1997, section 9.2.4: n² / (n² + o²).
TEST(PowerHeuristic, OfValuesByHand) {
  EXPECT_FLOAT_EQ(detail::power_heuristic(1.0f, 3.0f), 0.1f);
  EXPECT_FLOAT_EQ(detail::power_heuristic(3.0f, 1.0f), 0.9f);
  EXPECT_FLOAT_EQ(detail::power_heuristic(4.0f, 2.0f), 0.8f);
  EXPECT_FLOAT_EQ(detail::power_heuristic(0.7f, 0.7f), 0.5f);
  EXPECT_FLOAT_EQ(detail::power_heuristic(2.0f, 0.0f), 1.0f);
  EXPECT_FLOAT_EQ(detail::power_heuristic(1e-30f, 3e-30f), 0.1f) << "squares leave float";
  const Float8 eight = detail::power_heuristic(splat(2.0f), Float8{0, 1, 2, 3, 4, 5, 6, 7});
  for (int i = 0; i < simd_lanes; ++i) {
    EXPECT_FLOAT_EQ(eight[i], 4.0f / (4.0f + float(i * i))) << i;
  }
}

double power_heuristic_of(double pdf, double other) {
  return pdf * pdf / (pdf * pdf + other * other);
}

TEST(PowerHeuristic, WeighsEveryLightThatAPathFinds) {
  int direct = 0;
  int met = 0;
  int escaped = 0;
  for (const LitCase& c : lit_cases()) {
    for (const Material& floor : {diffuse(0.7f), rough_metal()}) {
      const TraceScene scene = lit_floor(c, floor);
      const RenderSettings settings = one_point(IntegratorId::mis, 6);
      for (std::uint32_t index = 0; index < 400; ++index) {
        const PathLog log = log_path(scene, settings, 0, 0, index);
        for (std::size_t i = 0; i < log.vertices.size(); ++i) {
          const PathVertex& vertex = log.vertices[i];
          if (vertex.direct) {
            const DirectLight& found = *vertex.direct;
            ASSERT_NEAR(double(found.weight),
                        power_heuristic_of(double(found.light.pdf), double(found.bsdf.pdf)), 1e-5);
            ++direct;
          }
          if (!vertex.emitted) {
            continue;
          }
          if (i == 0) {
            ASSERT_EQ(vertex.emitted->weight, 1.0f) << "seen by the camera alone";
            continue;
          }
          const PathVertex& before = log.vertices[i - 1];
          const glm::vec3 from = offset_origin(*before.surface, before.direction);
          const double light = vertex.surface
                                   ? double(scene.lights().pdf(*vertex.surface, from,
                                                               before.direction, vertex.distance))
                                   : double(scene.lights().environment_pdf());
          ASSERT_NEAR(double(vertex.emitted->weight),
                      power_heuristic_of(double(before.scattered->pdf), light), 1e-4);
          ++(vertex.surface ? met : escaped);
        }
      }
    }
  }
  EXPECT_GT(direct, 500);
  EXPECT_GT(met, 200);
  EXPECT_GT(escaped, 200);
}

/// What a sample would be with the weights of the balance heuristic, Veach's other one.
double balanced(const PathLog& log, double environment_pdf) {
  double sum = 0.0;
  if (const auto& direct = log.vertices[0].direct) {
    const double light = double(direct->light.pdf);
    const double balance = light / (light + double(direct->bsdf.pdf));
    sum += double(direct->contribution.y) * balance / double(direct->weight);
  }
  if (log.vertices.size() > 1 && log.vertices[1].emitted) {
    const FoundLight& found = *log.vertices[1].emitted;
    const double bsdf = double(log.vertices[0].scattered->pdf);
    const double balance = bsdf / (bsdf + environment_pdf);
    sum += double(found.contribution.y) * balance / double(found.weight);
  }
  return sum;
}

// A shiny metal under an even sky: one way finds nearly all there is, and the other is to be left
// out where it only adds noise.
TEST(PowerHeuristic, LeavesLessVarianceThanBalanceWould) {
  Scene scene;
  add_shape(scene, parallelogram({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), rough_metal(0.15f));
  scene.environment = ConstantEnvironment{glm::vec3(1.0f)};
  const TraceScene trace(std::move(scene));
  const RenderSettings settings = one_point(IntegratorId::mis, 2);
  Moments power;
  Moments balance;
  for (std::uint32_t index = 0; index < 4096; ++index) {
    const PathLog log = log_path(trace, settings, 0, 0, index);
    power.add(double(log.radiance.y));
    balance.add(balanced(log, double(trace.lights().environment_pdf())));
  }
  EXPECT_NEAR(power.mean() / balance.mean(), 1.0, 0.02);
  EXPECT_LT(power.variance(), 0.9 * balance.variance());
}

}  // namespace
}  // namespace quartet
