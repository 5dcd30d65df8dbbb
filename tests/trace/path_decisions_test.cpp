#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/trace/camera_rays.h"
#include "renderer/trace/path.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/statistics.h"
#include "tests/trace/test_scenes.h"

// Every decision of a path has random numbers of its own: where in the pixel and on the lens it
// begins, and at each vertex which light it asks and where it goes on. Two that shared a number
// would depend on each other.

namespace quartet {
namespace {

using namespace test;

constexpr int cells = 16;

/// Equal shares of the unit square.
int cell_of_square(double u, double v) {
  return std::clamp(int(4.0 * u), 0, 3) * 4 + std::clamp(int(4.0 * v), 0, 3);
}

/// Equal shares of the unit disk.
int cell_of_disk(double x, double y) {
  const double angle = std::atan2(y, x) / (2.0 * std::numbers::pi) + 0.5;
  return cell_of_square(x * x + y * y, angle);
}

/// The cells of what one path decided, by name.
using Decisions = std::map<std::string, int>;

/// Reads decisions off the rays of a path: lights are the environment, all of the sphere.
class Reader : public NoObserver {
 public:
  void vertex(const Surface&, float, glm::vec3) { ++vertices_; }
  void occluded(const Ray& ray) {
    const glm::vec3 d = ray.direction;
    decisions[name("light")] =
        cell_of_square(0.5 + 0.5 * double(d.z),
                       std::atan2(double(d.y), double(d.x)) / (2 * std::numbers::pi) + 0.5);
  }
  void scattered(const BsdfSample& sample, glm::vec3) {
    decisions[name("direction")] = cell_of_disk(double(sample.wi.x), double(sample.wi.y));
  }

  Decisions decisions;

 private:
  std::string name(const char* what) const { return what + std::to_string(vertices_); }
  int vertices_ = 0;
};

/// Between two grey planes that go on forever, as good as: whatever was decided, the next vertex
/// has the same normal. The environment cannot be seen, and is asked for at every vertex; half of
/// its directions lie behind the plane.
TraceScene between_planes() {
  constexpr float far = 4000.0f;
  Scene scene;
  add_shape(scene, parallelogram({-far, -far, -1}, {2 * far, 0, 0}, {0, 2 * far, 0}),
            diffuse(0.9f));
  add_shape(scene, parallelogram({-far, -far, 1}, {0, 2 * far, 0}, {2 * far, 0, 0}), diffuse(0.9f));
  scene.environment = ConstantEnvironment{glm::vec3(1.0f)};
  scene.camera = pinhole({0, 0, 0}, {0.2f, 0.3f, -1.0f}, {0, 1, 0}, 40.0f);
  scene.camera.aperture_radius = 0.25f;
  scene.camera.focus_distance = 2.0f;
  return TraceScene(std::move(scene));
}

/// Where on the lens and in the pixel a ray of the camera begins.
void read_camera(const Camera& camera, const Ray& ray, int x, int y, int width, int height,
                 Decisions& decisions) {
  const glm::dvec3 shift(ray.origin - camera.origin);
  const double radius = double(camera.aperture_radius);
  decisions["lens"] = cell_of_disk(glm::dot(shift, glm::dvec3(camera.right)) / radius,
                                   glm::dot(shift, glm::dvec3(camera.up)) / radius);
  // The point in focus, seen from the middle of the lens.
  const glm::dvec3 direction(ray.direction);
  const double ahead = glm::dot(direction, glm::dvec3(camera.forward));
  const glm::dvec3 point = shift + direction * (double(camera.focus_distance) / ahead);
  const double scale = 0.5 * width /
                       (std::tan(0.5 * double(camera.fov) * std::numbers::pi / 180.0) *
                        double(camera.focus_distance));
  decisions["pixel"] =
      cell_of_square(0.5 * width + glm::dot(point, glm::dvec3(camera.right)) * scale - x,
                     0.5 * height - glm::dot(point, glm::dvec3(camera.up)) * scale - y);
}

std::vector<Decisions> decisions_of_paths(std::uint32_t count) {
  const TraceScene scene = between_planes();
  const Camera& camera = scene.scene().camera;
  constexpr int size = 8;
  const CameraRays rays(camera, size, size);
  std::vector<Decisions> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    Sampler sampler(5, i, 0);  // of another pixel each: samples of one are stratified
    const Ray ray = rays.ray(3, 5, sampler.next());
    Reader reader;
    read_camera(camera, ray, 3, 5, size, size, reader.decisions);
    trace_path<true>(scene, ray, sampler, 5, reader);
    all.push_back(std::move(reader.decisions));
  }
  return all;
}

/// Whether two decisions depend on each other, by counts of their cells side by side. The margins
/// are taken as they are, with which the probability comes out too large rather than too small.
ChiSquare dependence(const std::vector<Decisions>& all, const std::string& a,
                     const std::string& b) {
  std::array<double, cells> of_a{};
  std::array<double, cells> of_b{};
  std::array<double, cells * cells> observed{};
  double count = 0.0;
  for (const Decisions& each : all) {
    const auto x = each.find(a);
    const auto y = each.find(b);
    if (x != each.end() && y != each.end()) {
      of_a[std::size_t(x->second)] += 1.0;
      of_b[std::size_t(y->second)] += 1.0;
      observed[std::size_t(x->second * cells + y->second)] += 1.0;
      count += 1.0;
    }
  }
  EXPECT_GT(count, 3000.0) << a << ", " << b;
  std::array<double, cells * cells> expected{};
  for (std::size_t i = 0; i < cells; ++i) {
    for (std::size_t j = 0; j < cells; ++j) {
      expected[i * cells + j] = of_a[i] * of_b[j] / count;
    }
  }
  return chi_square_test(observed, expected);
}

// False-alarm rate 1e-3 over all pairs.
TEST(PathDecisions, DependOnNoOther) {
  const std::vector<Decisions> all = decisions_of_paths(20000);
  const std::vector<std::string> names{"pixel",  "lens",       "light1", "direction1",
                                       "light2", "direction2", "light3", "direction3"};
  const double level = sidak_level(1e-3, 0.5 * double(names.size() * (names.size() - 1)));
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const ChiSquare result = dependence(all, names[i], names[j]);
      EXPECT_GE(result.p, level) << names[j] << " and " << names[i] << ": " << result.describe();
    }
  }
}

TEST(PathDecisions, ASharedNumberIsNoticed) {
  std::vector<Decisions> all;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Sampler sampler(5, i, 0);
    const Sampler::Draws& draws = sampler.next();
    all.push_back({{"a", cell_of_square(double(draws[0]), double(draws[1]))},
                   {"b", cell_of_square(double(draws[2]), double(draws[1]))},
                   {"c", cell_of_square(double(draws[2]), double(draws[3]))}});
  }
  EXPECT_LT(dependence(all, "a", "b").p, 1e-10);
  EXPECT_GT(dependence(all, "a", "c").p, 1e-3);  // false-alarm rate
}

}  // namespace
}  // namespace quartet
