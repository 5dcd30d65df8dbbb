#include "renderer/trace/path_lanes.h"

#include <gtest/gtest.h>

#include "renderer/trace/path.h"
#include "tests/trace/bits.h"
#include "tests/trace/test_scenes.h"

// Eight paths at a time are each, to the bit, the path that trace_path makes: on every scene, with
// every integrator and sampler, whatever is asked for together.

namespace quartet {
namespace {

using namespace test;

struct Reference {
  glm::vec3 radiance;
  int rays;
};

struct RayCounter : NoObserver {
  int rays = 0;
  void closest_hit(const Ray&) { ++rays; }
  void occluded(const Ray&) { ++rays; }
};

Reference single_path(const TraceScene& scene, const RenderSettings& settings,
                      const CameraRays& camera, int x, int y, std::uint32_t index) {
  const auto pixel = std::uint32_t(y * settings.width + x);
  Sampler sampler(settings.seed, pixel, index, settings.sampler);
  const Ray ray = camera.ray(x, y, sampler.next());
  RayCounter counter;
  const glm::vec3 radiance =
      settings.integrator == IntegratorId::mis
          ? trace_path<true>(scene, ray, sampler, settings.max_depth, counter, settings.roulette)
          : trace_path<false>(scene, ray, sampler, settings.max_depth, counter, settings.roulette);
  return {radiance, counter.rays};
}

/// The samples of a picture, in calls of so many pixels; of pixel p, `first` and the p % 4 after.
struct TracedPicture {
  std::vector<std::vector<glm::vec3>> radiance;
  std::vector<std::vector<std::uint16_t>> rays;
  std::vector<double> work;
};

TracedPicture render(const TraceScene& scene, const RenderSettings& settings,
                     std::size_t pixels_a_call, std::uint32_t first) {
  const CameraRays camera(settings.camera, settings.width, settings.height);
  TracedPicture picture;
  std::vector<SampleJob> jobs;
  for (int i = 0; i < settings.width * settings.height; ++i) {
    picture.radiance.emplace_back(std::size_t(i % 4), glm::vec3(-1.0f));
    picture.rays.emplace_back(std::size_t(i % 4), std::uint16_t(0));
  }
  jobs.reserve(picture.radiance.size());
  for (int i = 0; i < settings.width * settings.height; ++i) {
    jobs.push_back({i % settings.width, i / settings.width, first, picture.radiance[std::size_t(i)],
                    picture.rays[std::size_t(i)]});
  }
  for (std::span<SampleJob> rest = jobs; !rest.empty();) {
    const std::size_t count = std::min(pixels_a_call, rest.size());
    integrator(settings.integrator).trace_jobs(scene, settings, camera, rest.first(count));
    rest = rest.subspan(count);
  }
  picture.work.reserve(jobs.size());
  for (const SampleJob& job : jobs) {
    picture.work.push_back(job.work);
  }
  return picture;
}

void expect_single_paths(const TraceScene& scene, RenderSettings settings) {
  settings.width = 37;
  settings.height = 23;
  const CameraRays camera(settings.camera, settings.width, settings.height);
  for (const Integrator& row : integrators()) {
    settings.integrator = row.key;
    for (const int max_depth : {1, 2, 3, 6, std::numeric_limits<int>::max()}) {
      settings.max_depth = max_depth;
      settings.roulette = max_depth != 6;
      ++settings.seed;
      settings.sampler = samplers()[settings.seed % samplers().size()].key;
      SCOPED_TRACE(std::string(row.id) + ", depth " + std::to_string(max_depth) + ", " +
                   std::string(sampler_row(settings.sampler).id));
      const TracedPicture picture = render(scene, settings, 100, 5);
      std::size_t different = 0;
      for (int i = 0; i < settings.width * settings.height; ++i) {
        const std::vector<glm::vec3>& pixel = picture.radiance[std::size_t(i)];
        int rays = 0;
        for (std::size_t k = 0; k < pixel.size(); ++k) {
          const Reference one = single_path(scene, settings, camera, i % settings.width,
                                            i / settings.width, 5 + std::uint32_t(k));
          different += bits(one.radiance) != bits(pixel[k]);
          rays += one.rays;
          EXPECT_EQ(picture.rays[std::size_t(i)][k], one.rays) << "pixel " << i;
        }
        EXPECT_EQ(picture.work[std::size_t(i)], double(rays)) << "pixel " << i;
      }
      EXPECT_EQ(different, 0u);
    }
  }
}

TEST(PathLanes, AreSinglePathsInEveryBuiltinScene) {
  for (const std::string& name : builtin_scenes()) {
    SCOPED_TRACE(name);
    const TraceScene scene(load_scene(find_scene(name)));
    expect_single_paths(scene, default_settings(scene.scene()));
  }
}

/// Every kind of shape, material and light, textured and plain, side by side.
Scene zoo() {
  Scene scene;
  scene.textures.push_back(
      Checkerboard{glm::vec3(0.9f, 0.2f, 0.1f), glm::vec3(0.1f, 0.3f, 0.8f), glm::mat3(5.0f)});
  Material textured = textured_diffuse();
  textured.two_sided = true;
  add_shape(scene, parallelogram({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), textured);
  add_shape(scene, parallelogram({-5, 0, -3}, {10, 0, 0}, {0, 6, 0}), diffuse(0.7f));
  // Seen from behind: one side only.
  add_shape(scene, parallelogram({1.5f, 0, 1}, {0, 1, 0}, {1, 0, 0}), diffuse(0.7f));

  const Metal metal{.reflectance = {glm::vec3(0.9f)}};
  Material rough;
  rough.kind = RoughConductor{metal};
  rough.two_sided = true;
  Material mirror;
  mirror.kind = Conductor{metal};
  mirror.two_sided = true;
  Sphere ball;
  ball.radius = 0.6f;
  float x = -2.0f;
  for (const Material& material : {rough, mirror, glass(1.5046f), diffuse(0.6f)}) {
    ball.center = {x, 0.6f, 0.0f};
    add_shape(scene, ball, material);
    x += 1.3f;
  }
  Mesh smooth = parallelogram({-3, 0.1f, 2}, {1.5f, 0.3f, 0}, {0, 0.4f, -1});
  smooth.normals = {{-0.3f, 1, 0.2f}, {0.3f, 1, 0.2f}, {0.3f, 1, -0.2f}, {-0.3f, 1, -0.2f}};
  add_shape(scene, smooth, diffuse(0.8f));
  Disk disk;
  disk.center = {0, 0.5f, 1.5f};
  disk.radius = 0.4f;
  add_shape(scene, disk, rough);

  Mesh triangle;
  triangle.positions = {{-2, 4, -1}, {-1, 4, -1}, {-2, 4, 0}};
  triangle.triangles = {{0, 1, 2}};
  add_light(scene, triangle, 12.0f);
  add_light(scene, parallelogram({0, 4, -1}, {1, 0, 0}, {0, 0, 1}), 8.0f);
  Shape& shining = add_light(scene, parallelogram({2, 4, -1}, {1, 0, 0}, {0, 0, 1}), 0.0f);
  shining.radiance.texture = 0;
  ball.center = {-3.5f, 3, 1};
  ball.radius = 0.3f;
  add_light(scene, ball, 15.0f);
  disk.center = {3.5f, 3, 1};
  disk.normal = {0, -1, 0};
  disk.axis_v = {0, 0, 1};
  add_light(scene, disk, 15.0f);
  scene.delta_lights.push_back(PointLight{{0, 3, 3}, glm::vec3(6.0f, 5.0f, 4.0f)});
  scene.environment = ConstantEnvironment{glm::vec3(0.1f, 0.2f, 0.3f)};
  scene.camera = pinhole({0, 2.5f, 7}, {0, 1, 0}, {0, 1, 0}, 50.0f);
  return scene;
}

TEST(PathLanes, AreSinglePathsAmongAllShapesMaterialsAndLights) {
  const TraceScene scene(zoo());
  expect_single_paths(scene, default_settings(scene.scene()));
  RenderSettings lens = default_settings(scene.scene());
  lens.camera.aperture_radius = 0.1f;
  lens.camera.focus_distance = 6.0f;
  expect_single_paths(scene, lens);
}

TEST(PathLanes, AreSinglePathsUnderEachLightAlone) {
  const Scene all = zoo();
  const auto lights = std::size_t(
      std::count_if(all.shapes.begin(), all.shapes.end(), [](const Shape& s) { return s.emits; }));
  ASSERT_EQ(lights, 5u);
  for (std::size_t only = 0; only < lights + 2; ++only) {
    SCOPED_TRACE(only);
    Scene scene = all;
    std::size_t light = 0;
    for (Shape& shape : scene.shapes) {
      shape.emits = shape.emits && light++ == only;
    }
    if (only != lights) {
      scene.delta_lights.clear();
    }
    if (only != lights + 1) {
      scene.environment = ConstantEnvironment{glm::vec3(0.0f)};
    }
    const TraceScene trace(std::move(scene));
    expect_single_paths(trace, default_settings(trace.scene()));
  }
}

TEST(PathLanes, DoNotDependOnWhatIsAskedForTogether) {
  const TraceScene scene(zoo());
  RenderSettings settings = default_settings(scene.scene());
  settings.width = 40;
  settings.height = 30;
  const TracedPicture whole = render(scene, settings, 1200, 0);
  for (const std::size_t pixels :
       {std::size_t(1), std::size_t(3), std::size_t(10), std::size_t(17)}) {
    EXPECT_EQ(render(scene, settings, pixels, 0).radiance, whole.radiance) << pixels;
  }
}

}  // namespace
}  // namespace quartet
