#include "renderer/trace/path_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "renderer/scene/load_scene.h"

namespace quartet {
namespace {

std::uint64_t bits(const glm::vec3& v) {
  std::uint32_t words[3];
  std::memcpy(words, &v, sizeof words);
  return (std::uint64_t(words[0]) * 31 + words[1]) * 31 + words[2];
}

TEST(PathLog, GivesTheSampleOfTheRendererToTheBit) {
  for (const std::string& name : builtin_scenes()) {
    const TraceScene scene(open_scene(name));
    RenderSettings settings = default_settings(scene.scene());
    settings.seed = 3;
    for (const Integrator& row : integrators()) {
      settings.integrator = row.key;
      const CameraRays camera(settings.camera, settings.width, settings.height);
      for (int i = 0; i < 40; ++i) {
        const int x = (i * 37 + 5) % settings.width;
        const int y = (i * 53 + 11) % settings.height;
        const auto index = std::uint32_t(i * 7);
        settings.sampler = samplers()[std::size_t(i) % samplers().size()].key;
        glm::vec3 sample(0.0f);
        row.trace(scene, settings, camera, x, y, index, std::span(&sample, 1));
        const PathLog log = log_path(scene, settings, x, y, index);
        EXPECT_EQ(bits(log.radiance), bits(sample))
            << name << " " << row.id << " " << x << "," << y;
      }
    }
  }
}

TEST(PathLog, WhatIsWrittenDownAddsUpToTheSample) {
  const TraceScene scene(open_scene("cornell-checker"));
  RenderSettings settings = default_settings(scene.scene());
  std::size_t longest = 0;
  int lit = 0;
  for (int i = 0; i < 200; ++i) {
    const PathLog log =
        log_path(scene, settings, 200 + (i * 37) % 560, (i * 53) % 540, std::uint32_t(i));
    ASSERT_FALSE(log.vertices.empty());
    glm::dvec3 sum(0.0);
    for (const PathVertex& vertex : log.vertices) {
      sum += vertex.emitted ? glm::dvec3(vertex.emitted->contribution) : glm::dvec3(0.0);
      sum += vertex.direct ? glm::dvec3(vertex.direct->contribution) : glm::dvec3(0.0);
      EXPECT_TRUE(vertex.surface || log.end == PathEnd::escaped);
    }
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(sum[c], double(log.radiance[c]), 1e-5 * (1.0 + double(log.radiance[c]))) << i;
    }
    longest = std::max(longest, log.vertices.size());
    lit += log.radiance != glm::vec3(0.0f) ? 1 : 0;
  }
  EXPECT_GT(longest, 4u);
  EXPECT_GT(lit, 50);
}

TEST(PathLog, VerticesFollowEachOtherAlongTheirDirections) {
  const TraceScene scene(open_scene("cornell-checker"));
  const RenderSettings settings = default_settings(scene.scene());
  int followed = 0;
  for (int i = 0; i < 50; ++i) {
    const PathLog log = log_path(scene, settings, 300 + i * 5, 100 + i * 7, 1);
    for (std::size_t k = 1; k < log.vertices.size(); ++k) {
      const PathVertex& before = log.vertices[k - 1];
      const PathVertex& here = log.vertices[k];
      ASSERT_TRUE(before.surface && before.scattered);
      if (!here.surface) {
        continue;
      }
      const glm::vec3 there = before.surface->position + before.direction * here.distance;
      EXPECT_LT(glm::length(there - here.surface->position), 0.1f) << i << " " << k;
      const glm::vec3 expected = before.throughput * before.scattered->weight /
                                 (before.survival ? *before.survival : 1.0f);
      EXPECT_LT(glm::length(expected - here.throughput), 1e-5f * (1.0f + glm::length(expected)));
      ++followed;
    }
  }
  EXPECT_GT(followed, 50);
}

TEST(PathLog, SaysWhyAPathEnded) {
  const TraceScene scene(open_scene("cornell-checker"));
  RenderSettings settings = default_settings(scene.scene());
  EXPECT_EQ(log_path(scene, settings, 2, 270, 0).end, PathEnd::escaped);  // the black margin
  settings.max_depth = 1;
  EXPECT_EQ(log_path(scene, settings, 480, 270, 0).end, PathEnd::depth);
  settings.max_depth = 1000;
  bool roulette = false;
  for (std::uint32_t index = 0; index < 100 && !roulette; ++index) {
    const PathLog log = log_path(scene, settings, 480, 500, index);
    roulette = log.end == PathEnd::roulette;
    EXPECT_TRUE(!roulette || log.vertices.back().survival);
  }
  EXPECT_TRUE(roulette);
}

}  // namespace
}  // namespace quartet
