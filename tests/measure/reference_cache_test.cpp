#include "renderer/measure/reference/reference_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "renderer/scene/load_scene.h"

namespace quartet {
namespace {

TEST(ReferenceCache, EachThingThatSamplesDependOnButTheSeedHasAFileOfItsOwn) {
  const Scene scene = load_scene(find_scene("cornell-checker"));
  const RenderSettings settings = default_settings(scene);
  std::set<std::filesystem::path> paths;
  const auto add = [&](const Scene& of, const RenderSettings& with) {
    return paths.insert(cached_reference_path("/cache", of, with)).second;
  };
  EXPECT_TRUE(add(scene, settings));
  EXPECT_FALSE(add(scene, settings));
  const auto changed = [&](auto change) {
    RenderSettings other = settings;
    change(other);
    return add(scene, other);
  };
  EXPECT_FALSE(changed([](RenderSettings& s) { s.seed = 7; }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.width += 1; }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.height += 1; }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.max_depth = 3; }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.integrator = IntegratorId::kajiya; }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.sampler = SamplerId::independent; }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.sampler = SamplerId::replicated; }));
  EXPECT_TRUE(changed(
      [](RenderSettings& s) { s.camera.origin.x = std::nextafter(s.camera.origin.x, 1e9f); }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.camera.right = -s.camera.right; }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.camera.up = -s.camera.up; }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.camera.forward = -s.camera.forward; }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.camera.fov += 0.1f; }));
  EXPECT_TRUE(changed([](RenderSettings& s) {
    s.camera.fov_axis = s.camera.fov_axis == FovAxis::x ? FovAxis::y : FovAxis::x;
  }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.camera.aperture_radius += 0.1f; }));
  EXPECT_TRUE(changed([](RenderSettings& s) { s.camera.focus_distance += 0.1f; }));
  Scene other = scene;
  other.environment = ConstantEnvironment{glm::vec3(0.5f, 0.0f, 0.0f)};
  EXPECT_TRUE(add(other, settings));
}

TEST(ReferenceCache, LiesWhereTheEnvironmentSays) {
  const auto old = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string(value ? value : "");
  };
  const std::string cache = old("XDG_CACHE_HOME");
  const std::string home = old("HOME");
  setenv("XDG_CACHE_HOME", "/some/cache", 1);
  EXPECT_EQ(reference_cache_folder(), "/some/cache/quartet/references");
  setenv("XDG_CACHE_HOME", "", 1);
  setenv("HOME", "/home/ada", 1);
  EXPECT_EQ(reference_cache_folder(), "/home/ada/.cache/quartet/references");
  unsetenv("HOME");
  EXPECT_EQ(reference_cache_folder(), "");
  setenv("XDG_CACHE_HOME", cache.c_str(), 1);
  setenv("HOME", home.c_str(), 1);
}

}  // namespace
}  // namespace quartet
