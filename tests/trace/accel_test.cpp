#include "renderer/trace/accel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "renderer/base/cancel.h"
#include "tests/trace/bits.h"
#include "tests/trace/test_scenes.h"

// What Accel promises of packets: what a ray meets does not depend, to the bit, on the rays beside
// it. Embree traverses a packet together or its rays one by one, as it sees fit, and orders what it
// meets accordingly; so rays are aimed where that could show, at corners and edges that several
// triangles share.

namespace quartet {
namespace {

using namespace test;

using Random = std::mt19937;

float uniform(Random& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}
glm::vec3 uniform_point(Random& random, glm::vec3 low, glm::vec3 high) {
  return {uniform(random, low.x, high.x), uniform(random, low.y, high.y),
          uniform(random, low.z, high.z)};
}

/// Hills of many triangles with flat ground through them, twice at the same height.
Scene hills(Random& random) {
  Scene scene;
  for (const auto& [side, height] : {std::pair{120, 0.05f}, {30, 0.0f}, {2, 0.0f}}) {
    Mesh mesh;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        mesh.positions.push_back({4.0f * float(x) / float(side - 1) - 2.0f,
                                  0.02f + uniform(random, -height, height),
                                  4.0f * float(y) / float(side - 1) - 2.0f});
      }
    }
    const auto columns = std::uint32_t(side);
    for (std::uint32_t y = 0; y + 1 < columns; ++y) {
      for (std::uint32_t x = 0; x + 1 < columns; ++x) {
        const std::uint32_t corner = y * columns + x;
        mesh.triangles.push_back({corner, corner + 1, corner + columns + 1});
        mesh.triangles.push_back({corner, corner + columns + 1, corner + columns});
      }
    }
    add_shape(scene, std::move(mesh), diffuse(0.5f));
  }
  return scene;
}

Scene round_shapes(Random& random) {
  Scene scene;
  for (int i = 0; i < 12; ++i) {
    Sphere sphere;
    sphere.center = uniform_point(random, {-2.0f, 0.0f, -2.0f}, {2.0f, 1.0f, 2.0f});
    sphere.radius = uniform(random, 0.05f, 0.5f);
    add_shape(scene, sphere, diffuse(0.5f));
    Disk disk;
    disk.center = uniform_point(random, {-2.0f, 0.0f, -2.0f}, {2.0f, 1.0f, 2.0f});
    disk.normal = glm::normalize(uniform_point(random, glm::vec3(-1.0f), glm::vec3(1.0f)));
    disk.radius = uniform(random, 0.05f, 0.5f);
    add_shape(scene, disk, diffuse(0.5f));
  }
  return scene;
}

/// Points worth aiming at: corners, and the outermost points of what is round.
std::vector<glm::vec3> landmarks(const Scene& scene) {
  std::vector<glm::vec3> points;
  for (const Shape& shape : scene.shapes) {
    if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
      points.insert(points.end(), mesh->positions.begin(), mesh->positions.end());
    } else if (const Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
      points.push_back(sphere->center + glm::vec3(sphere->radius, 0.0f, 0.0f));
    } else {
      points.push_back(std::get<Disk>(shape.geometry).center);
    }
  }
  return points;
}

std::vector<Ray> rays_into(const Scene& scene, const Accel& accel, std::size_t count,
                           Random& random) {
  const std::vector<glm::vec3> points = landmarks(scene);
  const auto landmark = [&] { return points[random() % points.size()]; };
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const float kind = uniform(random, 0.0f, 1.0f);
    const std::size_t start = random() % 3;
    const glm::vec3 from = start == 0 ? landmark()
                           : start == 1
                               ? scene.camera.origin
                               : uniform_point(random, accel.bounds_min(), accel.bounds_max());
    const std::size_t first = random() % points.size();
    const std::size_t second = (first + 1) % points.size();
    const glm::vec3 to = kind < 0.4f ? landmark()
                         : kind < 0.6f
                             ? glm::mix(points[first], points[second], uniform(random, 0.0f, 1.0f))
                             : uniform_point(random, accel.bounds_min(), accel.bounds_max());
    const float distance = glm::length(to - from);
    if (distance > 0.0f) {
      Ray ray{from, (to - from) / distance};
      ray.t_max = random() % 2 ? distance * 0.9999f : ray.t_max;
      rays.push_back(ray);
    }
  }
  return rays;
}

struct Answer {
  bool met = false;
  Hit hit{};
  bool occluded = false;
};

Answer alone(const Accel& accel, const Ray& ray) {
  Answer answer;
  Hit hit;
  answer.met = accel.closest_hit(ray, hit);
  if (answer.met) {
    answer.hit = hit;
  }
  answer.occluded = accel.occluded(ray);
  return answer;
}

void expect_the_same_in_any_company(const Scene& scene, std::size_t count) {
  Random random(7);
  const Accel accel(scene);
  const std::vector<Ray> rays = rays_into(scene, accel, count, random);
  std::vector<Answer> expected;
  std::size_t met = 0;
  for (const Ray& ray : rays) {
    expected.push_back(alone(accel, ray));
    met += expected.back().met;
  }
  EXPECT_GT(met, count / 20);  // where all is one wall, most rays start in its plane
  std::vector<std::size_t> order(rays.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::size_t compared = 0;
  std::size_t different = 0;
  // First neighbours in all lanes, then strangers, of whom ever fewer are asked for.
  for (const unsigned of_eight : {8u, 8u, 6u, 4u, 2u}) {
    for (std::size_t first = 0; first + simd_lanes <= rays.size(); first += simd_lanes) {
      Ray8 packet{};
      Mask8 asked{};
      for (int lane = 0; lane < simd_lanes; ++lane) {
        const Ray& ray = rays[order[first + std::size_t(lane)]];
        set_lane(packet.origin, lane, ray.origin);
        set_lane(packet.direction, lane, ray.direction);
        packet.t_max[lane] = ray.t_max;
        asked[lane] = random() % 8 < of_eight ? -1 : 0;
      }
      const Hit8 hits = accel.closest_hit(packet, asked);
      const Mask8 occluded = accel.occluded(packet, asked);
      for (int lane = 0; lane < simd_lanes; ++lane) {
        const Answer& one = expected[order[first + std::size_t(lane)]];
        if (!asked[lane]) {
          ASSERT_FALSE(hits.met[lane] || occluded[lane]);
          continue;
        }
        const Hit hit{hits.t[lane], hits.u[lane], hits.v[lane], hits.shape[lane],
                      hits.primitive[lane]};
        const bool same = bool(hits.met[lane]) == one.met && bool(occluded[lane]) == one.occluded &&
                          (!one.met || bits(hit) == bits(one.hit));
        different += !same;
        ++compared;
      }
    }
    std::shuffle(order.begin(), order.end(), random);
  }
  EXPECT_GT(compared, 3 * count);
  EXPECT_EQ(different, 0u) << "of " << compared;
}

TEST(Accel, PacketsOfTrianglesAreEightSingleRays) {
  Random random(1);
  expect_the_same_in_any_company(hills(random), 200000);
}

TEST(Accel, PacketsOfRoundShapesAreEightSingleRays) {
  Random random(2);
  expect_the_same_in_any_company(round_shapes(random), 100000);
}

TEST(Accel, PacketsInEveryBuiltinSceneAreEightSingleRays) {
  for (const std::string& name : builtin_scenes()) {
    SCOPED_TRACE(name);
    expect_the_same_in_any_company(load_scene(find_scene(name)), 20000);
  }
}

TEST(Accel, ARayThatIsNoneMeetsNothing) {
  // Debian's Embree ends the program for such rays.
  Scene scene;
  add_shape(scene, parallelogram({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}), diffuse(0.5f));
  const Accel accel(scene);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const Ray good{{0.1f, 0.2f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  Hit hit{};
  EXPECT_TRUE(accel.closest_hit(good, hit));
  EXPECT_TRUE(accel.occluded(good));
  for (const float bad : {nan, inf, -inf, 2e18f, -3e38f}) {
    for (int i = 0; i < 6; ++i) {
      Ray ray = good;
      (i < 3 ? ray.origin : ray.direction)[i % 3] = bad;
      EXPECT_FALSE(accel.closest_hit(ray, hit)) << i << " is " << bad;
      EXPECT_FALSE(accel.occluded(ray)) << i << " is " << bad;
    }
  }
  Ray ray = good;
  ray.t_max = nan;
  EXPECT_FALSE(accel.occluded(ray));
  // Beside a good one in the same packet.
  Ray8 rays{splat(good.origin), splat(good.direction), splat(good.t_max)};
  rays.origin.x[3] = nan;
  EXPECT_EQ(lane_bits(accel.closest_hit(rays, ~Mask8{}).met), 0xf7u);
  EXPECT_EQ(lane_bits(accel.occluded(rays, ~Mask8{})), 0xf7u);
}

TEST(Accel, BuildingCanBeCancelled) {
  Random random(1);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(Accel(hills(random), stop.get_token()), Cancelled);
  EXPECT_THROW(TraceScene(hills(random), stop.get_token()), Cancelled);
}

}  // namespace
}  // namespace quartet
