#include "renderer/trace/light_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/trace/frame.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/statistics.h"
#include "tests/trace/test_scenes.h"

namespace quartet {
namespace {

using namespace test;

/// A light, and a point that it shines on. The light lies within `cos_cone` around `axis`.
struct Case {
  std::string name;
  std::function<void(Scene&)> build;
  glm::vec3 from;
  glm::vec3 axis;
  float cos_cone;
  double solid_angle;
};

/// Of the rectangle [x0, x1] × [y0, y1] at distance d from the origin.
double solid_angle(double x0, double x1, double y0, double y1, double d) {
  const auto corner = [=](double x, double y) {
    return std::atan(x * y / (d * std::sqrt(x * x + y * y + d * d)));
  };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

/// Of a triangle: Van Oosterom and Strackee 1983.
double solid_angle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const double la = glm::length(a);
  const double lb = glm::length(b);
  const double lc = glm::length(c);
  const double down =
      la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
  return std::abs(2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), down));
}

const glm::vec3 corner(-0.5f, -0.4f, 1.0f);  // of a light above the origin, facing down

Mesh two_triangles() {
  Mesh mesh;
  mesh.positions = {corner, {0.9f, -0.3f, 1.4f}, {0.2f, 0.8f, 1.1f}, {-0.9f, 0.5f, 0.9f}};
  mesh.uvs = {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  return mesh;
}

Sphere sphere(glm::vec3 center, float radius, bool flip_normals = false) {
  Sphere result;
  result.center = center;
  result.radius = radius;
  result.flip_normals = flip_normals;
  result.to_local = glm::mat3(0.36f, 0.48f, -0.8f, -0.8f, 0.6f, 0.0f, 0.48f, 0.64f, 0.6f);
  return result;
}

Disk disk(float radius) {
  Disk result;
  result.center = {0.0f, 0.0f, 1.0f};
  result.normal = {0.0f, 0.0f, -1.0f};
  result.axis_v = {0.0f, -1.0f, 0.0f};
  result.radius = radius;
  return result;
}

std::vector<Case> cases() {
  constexpr double sphere_angle = 2.0 * std::numbers::pi;
  const glm::vec3 up(0.0f, 0.0f, 1.0f);
  const auto flat = parallelogram(corner, {0.0f, 1.4f, 0.0f}, {1.0f, 0.0f, 0.0f});
  const Mesh mesh = two_triangles();
  const auto at = [&](std::size_t i) { return glm::dvec3(mesh.positions[i]); };
  const auto cap = [](double radius, double distance) {
    return sphere_angle * (1.0 - std::sqrt(1.0 - radius * radius / (distance * distance)));
  };
  const glm::vec3 slanted = glm::normalize(glm::vec3(1.0f, 2.0f, 3.0f));
  return {
      {"parallelogram", [=](Scene& s) { add_light(s, flat, 1.0f); }, glm::vec3(0.0f), up, 0.5f,
       solid_angle(-0.5, 0.5, -0.4, 1.0, 1.0)},
      {"parallelogram from aside", [=](Scene& s) { add_light(s, flat, 1.0f); },
       glm::vec3(-2.0f, 0.0f, 0.0f), glm::normalize(glm::vec3(2.0f, 0.3f, 1.0f)), 0.9f,
       solid_angle(1.5, 2.5, -0.4, 1.0, 1.0)},
      {"mesh", [=](Scene& s) { add_light(s, mesh, 1.0f); }, glm::vec3(0.0f), up, 0.5f,
       solid_angle(at(0), at(1), at(2)) + solid_angle(at(0), at(2), at(3))},
      {"sphere", [=](Scene& s) { add_light(s, sphere(2.0f * slanted, 1.0f), 1.0f); },
       glm::vec3(0.0f), slanted, 0.85f, cap(1.0, 2.0)},
      {"small far sphere", [=](Scene& s) { add_light(s, sphere(50.0f * slanted, 0.05f), 1.0f); },
       glm::vec3(0.0f), slanted, 1.0f - 6e-7f, cap(0.05, 50.0)},
      {"sphere close by", [=](Scene& s) { add_light(s, sphere(1.01f * slanted, 1.0f), 1.0f); },
       glm::vec3(0.0f), slanted, 0.0f, cap(1.0, 1.01)},
      {"sphere from inside",
       [=](Scene& s) { add_light(s, sphere(0.5f * slanted, 1.0f, true), 1.0f); }, glm::vec3(0.0f),
       slanted, -1.0f, 2.0 * sphere_angle},
      {"disk", [=](Scene& s) { add_light(s, disk(0.8f), 1.0f); }, glm::vec3(0.0f), up, 0.7f,
       sphere_angle * (1.0 - 1.0 / std::sqrt(1.0 + 0.64))},
      {"environment", [=](Scene& s) { s.environment = ConstantEnvironment{glm::vec3(1.0f)}; },
       glm::vec3(0.0f), up, -1.0f, 2.0 * sphere_angle},
  };
}

LightSample sample_of(const LightSampler& lights, glm::vec3 from, std::uint32_t seed,
                      std::uint32_t i) {
  Sampler sampler(seed, i, 0);  // another pixel each: independent samples
  const Sampler::Draws& d = sampler.next();
  return lights.sample(from, d[0], d[1]);
}

/// Density with which the light sampling finds a direction: what the integrator weighs with.
double density(const TraceScene& scene, glm::vec3 from, glm::vec3 direction) {
  Hit hit{};
  const Ray ray{from, direction};
  if (!scene.accel().closest_hit(ray, hit)) {
    return double(scene.lights().environment_pdf());
  }
  const Surface surface = scene.surface(ray, hit);
  return scene.emitted(surface, direction) == glm::vec3(0.0f)
             ? 0.0
             : double(scene.lights().pdf(surface, from, direction, hit.t));
}

TraceScene make(const Case& c) {
  Scene scene;
  scene.materials.emplace_back();
  c.build(scene);
  return TraceScene(std::move(scene));
}

TEST(Lights, SamplesKnowTheirDensityAndReachTheLight) {
  for (const Case& c : cases()) {
    const TraceScene scene = make(c);
    for (std::uint32_t i = 0; i < 5000; ++i) {
      const LightSample s = sample_of(scene.lights(), c.from, 1, i);
      ASSERT_EQ(s.radiance, glm::vec3(1.0f)) << c.name;
      ASSERT_NEAR(glm::length(s.direction), 1.0f, 1e-5f) << c.name;
      ASSERT_FALSE(scene.accel().occluded({c.from, s.direction, s.distance}))
          << c.name << " hides itself";
      Hit hit{};
      const Ray ray{c.from, s.direction};
      if (!scene.accel().closest_hit(ray, hit)) {
        // At a silhouette, rounding may push a direction past the edge.
        if (c.name != "environment") {
          const double cosine = double(glm::dot(s.direction, c.axis));
          ASSERT_TRUE(c.name.find("sphere") != std::string::npos) << c.name;
          ASSERT_NEAR(1.0 - cosine, c.solid_angle / (2.0 * std::numbers::pi), 1e-5) << c.name;
        }
        continue;
      }
      ASSERT_LT(s.distance, hit.t * (1.0f + 1e-5f)) << c.name;
      if (c.name.find("sphere") == std::string::npos) {
        ASSERT_GT(s.distance, 0.999f * hit.t) << c.name;
      }
      const double pdf = density(scene, c.from, s.direction);
      ASSERT_NEAR(double(s.pdf) / pdf, 1.0, 2e-3) << c.name;
    }
  }
}

TEST(Lights, MeanOfOneOverTheDensityIsTheSolidAngle) {
  const auto all = cases();
  const double level = sidak_level(1e-3, double(all.size()));  // false-alarm rate 1e-3
  for (const Case& c : all) {
    const TraceScene scene = make(c);
    Moments moments;
    for (std::uint32_t i = 0; i < 100000; ++i) {
      moments.add(1.0 / double(sample_of(scene.lights(), c.from, 2, i).pdf));
    }
    // Where every direction has the same density only its rounding is left.
    const double error = std::max(moments.standard_error(), 1e-6 * c.solid_angle);
    EXPECT_GE(two_sided_p((moments.mean() - c.solid_angle) / error), level)
        << c.name << ": " << moments.mean() << " for " << c.solid_angle << " ± " << error;
  }
}

TEST(Lights, SamplingFollowsTheDensity) {
  constexpr std::uint32_t count = 30000;
  constexpr int bins = 16;
  constexpr int steps = 24;
  const auto all = cases();
  const double level = sidak_level(1e-3, double(all.size()));  // false-alarm rate 1e-3
  for (const Case& c : all) {
    if (c.cos_cone > 0.999f) {
      continue;  // bins would be narrower than float directions
    }
    const TraceScene scene = make(c);
    const Frame frame(c.axis);
    const double cone = 1.0 - double(c.cos_cone);
    std::vector<double> expected(bins * bins, 0.0);
    for (int i = 0; i < bins * steps; ++i) {
      for (int j = 0; j < bins * steps; ++j) {
        const double z = 1.0 - (i + 0.5) / (bins * steps) * cone;
        const double phi = (j + 0.5) / (bins * steps) * 2.0 * std::numbers::pi;
        const double r = std::sqrt(1.0 - z * z);
        const glm::vec3 direction =
            frame.to_world(glm::vec3(r * std::cos(phi), r * std::sin(phi), z));
        expected[std::size_t((i / steps) * bins + j / steps)] +=
            count * density(scene, c.from, direction) * 2.0 * std::numbers::pi * cone /
            std::pow(double(bins * steps), 2.0);
      }
    }
    std::vector<double> observed(expected.size(), 0.0);
    for (std::uint32_t i = 0; i < count; ++i) {
      const glm::dvec3 d(frame.to_local(sample_of(scene.lights(), c.from, 3, i).direction));
      const double a = (1.0 - d.z) / cone;
      ASSERT_LT(a, 1.0 + 1e-6) << c.name << " samples outside of its cone";
      const double b = std::atan2(d.y, d.x) / (2.0 * std::numbers::pi);
      const auto row = std::size_t(std::clamp(a * bins, 0.0, bins - 1.0));
      observed[row * bins + std::size_t((b < 0.0 ? b + 1.0 : b) * bins) % bins] += 1.0;
    }
    // The midpoint rule is good to about 0.2 % here, where a silhouette crosses the bins.
    double total = 0.0;
    for (const double e : expected) {
      total += e;
    }
    EXPECT_NEAR(total / count, 1.0, 5e-3) << c.name;
    const ChiSquare result = chi_square_test(observed, expected);
    EXPECT_GE(result.p, level) << c.name << ": " << result.describe();
  }
}

TEST(Lights, AreChosenByPower) {
  Scene scene;
  add_light(scene, parallelogram({-4.0f, 0.0f, 2.0f}, {0.0f, 1.0f, 0.0f}, {2.0f, 0.0f, 0.0f}),
            1.0f);
  add_light(scene, sphere({2.0f, 0.0f, 1.0f}, 0.5f), 3.0f);
  add_light(scene, disk(0.8f), 7.0f);
  scene.environment = ConstantEnvironment{glm::vec3(0.2f)};
  const TraceScene trace(std::move(scene));
  const glm::vec3 size = trace.accel().bounds_max() - trace.accel().bounds_min();
  const double radius2 = 0.25 * double(glm::dot(size, size));
  const double square = std::numbers::pi * std::numbers::pi;
  const std::array<double, 4> power{std::numbers::pi * 2.0 * 1.0, square * 4.0 * 0.25 * 3.0,
                                    square * 0.64 * 7.0, square * 4.0 * radius2 * 0.2};
  constexpr std::uint32_t count = 100000;
  std::array<double, 4> expected{};
  for (std::size_t i = 0; i < 4; ++i) {
    expected[i] = count * power[i] / (power[0] + power[1] + power[2] + power[3]);
  }
  std::array<double, 4> observed{};
  for (std::uint32_t i = 0; i < count; ++i) {
    const float radiance = sample_of(trace.lights(), glm::vec3(0.0f), 4, i).radiance.x;
    observed[radiance == 1.0f ? 0 : radiance == 3.0f ? 1 : radiance == 7.0f ? 2 : 3] += 1.0;
  }
  const ChiSquare result = chi_square_test(observed, expected);
  EXPECT_GE(result.p, 1e-3) << result.describe();  // false-alarm rate 1e-3
}

TEST(Lights, ProbabilityIsExactlyTheShareOfNumbers) {
  // Random numbers have 24 bits: how many of them choose a light its probability must say exactly,
  // or what it adds would be wrong. However dim it is, there are some.
  constexpr double least = 256.0 * 0x1p-24;
  for (const float share : {0.3f, 1e-3f, 1e-6f, 3e-7f, 1e-9f, 1e-18f}) {
    Scene scene;
    const float area = 4.0f;
    add_light(scene, parallelogram({-1.0f, -1.0f, 1.0f}, {0.0f, 2.0f, 0.0f}, {2.0f, 0.0f, 0.0f}),
              1.0f);
    add_light(scene, parallelogram({-1.0f, -1.0f, 1.5f}, {0.0f, 2.0f, 0.0f}, {2.0f, 0.0f, 0.0f}),
              share / (1.0f - share));
    const TraceScene trace(std::move(scene));
    const auto at = [&](int number) {
      return trace.lights().sample(glm::vec3(0.0f), float(number) * 0x1p-24f, 0.5f);
    };
    int first = 0;         // chooses the first light
    int second = 1 << 24;  // would choose the second
    while (second - first > 1) {
      const int middle = (first + second) / 2;
      (at(middle).radiance.x == 1.0f ? first : second) = middle;
    }
    const double chosen = double((1 << 24) - second) * 0x1p-24;
    const bool dim = double(share) < least;
    EXPECT_NEAR(chosen, dim ? least + double(share) * (1.0 - 2.0 * least) : double(share), 0x1p-24);
    const Ray ray{{0.0f, 0.0f, 1.2f}, {0.0f, 0.0f, 1.0f}};
    Hit hit{};
    ASSERT_TRUE(trace.accel().closest_hit(ray, hit));
    const glm::vec3 from(0.0f);
    const double pdf =
        double(trace.lights().pdf(trace.surface(ray, hit), from, ray.direction, 1.5f));
    EXPECT_NEAR(pdf, chosen * 1.5 * 1.5 / double(area), 1e-6 * pdf);
  }
}

TEST(Lights, ALightOfFewNumbersIsSampledAllOver) {
  Scene scene;
  const auto flat = parallelogram(corner, {0.0f, 1.4f, 0.0f}, {1.0f, 0.0f, 0.0f});
  add_light(scene, flat, 1.0f);
  add_light(scene, flat, 1e-12f);
  const TraceScene trace(std::move(scene));
  constexpr int numbers = 256;
  constexpr int places = 64;
  // Along the first edge: all of it, and between two numbers too, where the other number leads.
  std::array<int, std::size_t(numbers) * 8> parts{};
  for (int number = 0; number < numbers; ++number) {
    for (int i = 0; i < places; ++i) {
      const float u = 1.0f - float(number + 1) * 0x1p-24f;
      const LightSample s =
          trace.lights().sample(glm::vec3(0.0f), u, (float(i) + 0.5f) / float(places));
      ASSERT_EQ(s.radiance, glm::vec3(1e-12f)) << "only the dim light has these numbers";
      const float along = (s.direction.y / s.direction.z - corner.y) / 1.4f;
      ++parts.at(std::size_t(std::clamp(along, 0.0f, 0.99999f) * float(parts.size())));
    }
  }
  for (const int count : parts) {
    EXPECT_NEAR(count, places / 8.0, places / 16.0);
  }
}

TEST(Lights, EveryKindIsChosenHoweverDim) {
  // A point light is found in no other way; the others would be noise without end.
  const std::vector<std::function<void(Scene&, float)>> kinds{
      [](Scene& s, float l) {
        add_light(s, parallelogram(corner, {0.0f, 1.4f, 0.0f}, {1.0f, 0.0f, 0.0f}), l);
      },
      [](Scene& s, float l) { add_light(s, two_triangles(), l); },
      [](Scene& s, float l) {
        add_light(s, sphere({0.0f, 0.0f, 3.0f}, 0.5f), l);
      },
      [](Scene& s, float l) { add_light(s, disk(0.8f), l); },
      [](Scene& s, float l) { s.environment = ConstantEnvironment{glm::vec3(l)}; },
      [](Scene& s, float l) {
        s.delta_lights.push_back(PointLight{{0.1f, 0.2f, 0.5f}, glm::vec3(l)});
      },
  };
  for (std::size_t dim = 0; dim < kinds.size(); ++dim) {
    for (std::size_t bright = 0; bright < kinds.size(); ++bright) {
      if (bright == dim) {
        continue;
      }
      Scene scene;
      // An environment has power by the size of the scene.
      add_shape(scene, parallelogram({-1.0f, -1.0f, -1.0f}, {0.0f, 2.0f, 0.0f}, {2.0f, 0.0f, 0.0f}),
                diffuse(0.5f));
      kinds[bright](scene, 1e6f);
      kinds[dim](scene, 1e-10f);
      const TraceScene trace(std::move(scene));
      // The interval of the dim one is among the first or last numbers, or between the two
      // triangles: every 128th number meets 256 of them somewhere.
      double probability = 0.0;
      int found = 0;
      constexpr int step = 128;
      for (int number = 0; number < 1 << 24; number += step) {
        const LightSample s =
            trace.lights().sample(glm::vec3(0.0f), float(number) * 0x1p-24f, 0.5f);
        // Also of the point light, within 1 of which nothing else is as dark.
        if (s.radiance.x > 0.0f && s.radiance.x < 1e-3f) {
          ++found;
          probability += step * 0x1p-24;
        }
      }
      EXPECT_GE(found, 256 / step) << dim << " beside " << bright;
      EXPECT_LT(probability, 1e-4) << dim << " beside " << bright;
    }
  }
}

TEST(Lights, ShineOnOneSideOnly) {
  struct Behind {
    std::string name;
    std::function<void(Scene&)> build;
    glm::vec3 from;
  };
  const std::vector<Behind> all{
      {"parallelogram",
       [](Scene& s) {
         add_light(s, parallelogram(corner, {0.0f, 1.4f, 0.0f}, {1.0f, 0.0f, 0.0f}), 1.0f);
       },
       {0.0f, 0.0f, 2.0f}},
      {"mesh", [](Scene& s) { add_light(s, two_triangles(), 1.0f); }, {0.0f, 0.0f, 9.0f}},
      {"disk", [](Scene& s) { add_light(s, disk(1.0f), 1.0f); }, {0.0f, 0.0f, 2.0f}},
      {"sphere", [](Scene& s) { add_light(s, sphere({}, 1.0f), 1.0f); }, {0.3f, 0.2f, 0.1f}},
      {"inner sphere",
       [](Scene& s) { add_light(s, sphere({}, 1.0f, true), 1.0f); },
       {0.0f, 0.0f, 2.0f}},
  };
  for (const Behind& c : all) {
    Scene scene;
    c.build(scene);
    const TraceScene trace(std::move(scene));
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const LightSample s = sample_of(trace.lights(), c.from, 5, i);
      Hit hit{};
      const Ray ray{c.from, s.direction};
      ASSERT_EQ(s.radiance, glm::vec3(0.0f)) << c.name;
      if (trace.accel().closest_hit(ray, hit)) {
        ASSERT_EQ(trace.emitted(trace.surface(ray, hit), s.direction), glm::vec3(0.0f)) << c.name;
      }
    }
  }
}

TEST(Lights, SampleTheRadianceThatAHitShows) {
  const std::vector<std::function<Shape&(Scene&)>> builders{
      [](Scene& s) -> Shape& {
        return add_light(s, parallelogram(corner, {0.0f, 1.4f, 0.0f}, {1.0f, 0.0f, 0.0f}), 1.0f);
      },
      [](Scene& s) -> Shape& { return add_light(s, two_triangles(), 1.0f); },
      [](Scene& s) -> Shape& {
        return add_light(s, sphere({0.5f, 1.0f, 2.0f}, 1.0f), 1.0f);
      },
      [](Scene& s) -> Shape& {
        return add_light(s, sphere({0.2f, 0.1f, 0.3f}, 1.0f, true), 1.0f);
      },
      [](Scene& s) -> Shape& { return add_light(s, disk(0.8f), 1.0f); },
  };
  for (std::size_t k = 0; k < builders.size(); ++k) {
    Scene scene;
    Checkerboard checker;
    checker.color0 = {1.0f, 2.0f, 3.0f};
    checker.color1 = {5.0f, 0.0f, 1.0f};
    checker.to_uv = glm::mat3(3.0f, 0.0f, 0.0f, 0.0f, 5.0f, 0.0f, 0.1f, 0.2f, 1.0f);
    scene.textures.push_back(checker);
    builders[k](scene).radiance.texture = 0;
    const TraceScene trace(std::move(scene));
    int compared = 0;
    std::array<int, 2> colors{};
    for (std::uint32_t i = 0; i < 4000; ++i) {
      const LightSample s = sample_of(trace.lights(), glm::vec3(0.0f), 6, i);
      const Ray ray{glm::vec3(0.0f), s.direction};
      Hit hit{};
      if (!trace.accel().closest_hit(ray, hit)) {
        continue;  // past the silhouette of a sphere by rounding
      }
      const Surface surface = trace.surface(ray, hit);
      const glm::vec2 squares = 2.0f * glm::vec2(checker.to_uv * glm::vec3(surface.uv, 1.0f));
      const glm::vec2 to_edge = glm::abs(squares - glm::round(squares));
      if (std::min(to_edge.x, to_edge.y) < 0.02f) {
        continue;  // rounding may see the neighbour
      }
      ASSERT_EQ(s.radiance, trace.emitted(surface, s.direction)) << "light " << k;
      ++colors[s.radiance == checker.color0 ? 0 : 1];
      ++compared;
    }
    EXPECT_GT(compared, 3400);
    EXPECT_GT(std::min(colors[0], colors[1]), 1000);
  }
}

TEST(Lights, WithoutAnyTheSampleIsBlack) {
  Scene scene;
  add_shape(scene, sphere({}, 1.0f), diffuse(0.5f));
  const TraceScene trace(std::move(scene));
  EXPECT_EQ(trace.lights().sample({2.0f, 0.0f, 0.0f}, 0.5f, 0.5f).radiance, glm::vec3(0.0f));
  EXPECT_EQ(trace.lights().environment_pdf(), 0.0f);
}

}  // namespace
}  // namespace quartet
