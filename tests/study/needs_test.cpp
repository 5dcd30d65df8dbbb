#include "renderer/study/needs/needs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/trace/test_scenes.h"

// Scenes whose needs are known without a measurement.

namespace quartet {
namespace {

using test::add_light;
using test::add_shape;
using test::diffuse;
using test::glass;
using test::parallelogram;
using test::perfect_mirror;
using test::pinhole;
using test::textured_diffuse;

/// A white floor below a black lamp: light that leaves the floor meets nothing that sends it back.
Scene one_bounce(Material floor = diffuse(0.8f)) {
  Scene scene;
  scene.name = "one bounce";
  scene.width = 32;
  scene.height = 18;
  scene.camera = pinhole({0.0f, 1.5f, 4.0f}, {0.0f, 0.5f, 0.0f}, {0.0f, 1.0f, 0.0f}, 50.0f);
  add_shape(scene, parallelogram({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), std::move(floor)).id = "floor";
  add_light(scene, parallelogram({-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}), 5.0f).id = "lamp";
  return scene;
}

NeedsPlan needs_plan_of(std::vector<PartId> parts) {
  NeedsPlan plan;
  plan.parts = std::move(parts);
  plan.spp = 8;
  plan.seeds = 6;
  plan.metric = MetricId::relmse;
  return plan;
}

NeedsResult needs_of(const Scene& scene, const NeedsPlan& plan) {
  auto result = run_needs(model_of(scene, default_settings(scene)), 1, plan, {}, {});
  EXPECT_TRUE(result && result->can_be_met);
  return std::move(*result);
}

const NeedsRow& row_called(const NeedsResult& result, const std::string& label) {
  const auto row = std::ranges::find(
      result.rows, label, [](const NeedsRow& each) { return each.simplification.label; });
  if (row == result.rows.end()) {
    throw std::out_of_range("no row " + label);
  }
  return *row;
}

void expect_need(const NeedsResult& result, const std::string& label, Need need) {
  const NeedsRow& row = row_called(result, label);
  EXPECT_EQ(int(row.need), int(need))
      << label << ": " << row.measured.error.mean << ", " << row.measured.error.low << " to "
      << row.measured.error.high << ", limit " << result.limit;
}

std::vector<std::string> taken_out(const NeedsResult& result) {
  std::vector<std::string> labels;
  for (const std::size_t i : result.taken_out) {
    labels.push_back(result.rows[i].simplification.label);
  }
  return labels;
}

TEST(Needs, WithoutASecondBounceDepthTwo) {
  const NeedsResult result = needs_of(one_bounce(), needs_plan_of({PartId::depth}));
  expect_need(result, "depth 1", Need::needed);
  expect_need(result, "depth 2", Need::not_needed);
  EXPECT_EQ(row_called(result, "depth 2").measured.error.high, 0.0) << "the same paths";
  EXPECT_EQ(result.rows.size(), 2u) << "deeper ones would tell nothing new";
  EXPECT_EQ(taken_out(result), std::vector<std::string>{"depth 2"});
  EXPECT_EQ(result.smallest_model.scene.max_depth, 2);
  EXPECT_LE(row_called(result, "depth 2").rays_ratio, 1.0);
}

TEST(Needs, ASecondBounceNeedsDepthThree) {
  Scene scene = one_bounce();
  // A wall beside the floor, which the lamp does not light: it shines with what the floor sends.
  add_shape(scene, parallelogram({-2, 0, -2}, {4, 0, 0}, {0, 3, 0}), diffuse(0.8f));
  scene.shapes[1].geometry = parallelogram({-0.5f, 3, -1.9f}, {1, 0, 0}, {0, 0, 0.2f});
  NeedsPlan plan = needs_plan_of({PartId::depth});
  plan.spp = 32;
  const NeedsResult result = needs_of(scene, plan);
  expect_need(result, "depth 2", Need::needed);
  EXPECT_GT(result.smallest_model.scene.max_depth, 2);
  for (std::size_t i = 1; i < result.rows.size(); ++i) {
    EXPECT_LE(result.rows[i].measured.error.mean, result.rows[i - 1].measured.error.mean + 1e-9);
    EXPECT_LE(result.rows[i].measured.energy.mean, 0.0) << "what is cut off is lost";
  }
}

TEST(Needs, ALightThatReachesNothingIsNotNeeded) {
  Scene scene = one_bounce();
  // Below the floor, shining down: nobody sees it, and yet half of all light samples go there.
  add_light(scene, parallelogram({-0.5f, -1, -0.5f}, {1, 0, 0}, {0, 0, 1}), 5.0f).id = "cellar";
  // Another choice of lights is other noise: enough pixels to tell that it is no more than that.
  scene.width = 96;
  scene.height = 54;
  const NeedsResult result = needs_of(scene, needs_plan_of({PartId::light}));
  expect_need(result, "'cellar' dark", Need::not_needed);
  expect_need(result, "'lamp' dark", Need::needed);
  EXPECT_EQ(taken_out(result), std::vector<std::string>{"'cellar' dark"});
  EXPECT_FALSE(result.smallest_model.scene.shapes.back().emits);
  // All samples go to the lamp now.
  EXPECT_LT(row_called(result, "'cellar' dark").measured.variance.high, 1.0);
}

TEST(Needs, TheOnlyLightIsNoPart) {
  EXPECT_TRUE(needs_of(one_bounce(), needs_plan_of({PartId::light})).rows.empty());
}

TEST(Needs, AConstantTextureNeedsItsMeanAndOneWithDetailDoesNotDo) {
  Scene scene = one_bounce(textured_diffuse());
  scene.textures = {Checkerboard{glm::vec3(0.5f), glm::vec3(0.5f)}};
  const NeedsResult constant = needs_of(scene, needs_plan_of({PartId::texture}));
  expect_need(constant, "texture of 'floor' → its mean", Need::not_needed);
  EXPECT_FALSE(
      std::get<Diffuse>(constant.smallest_model.scene.materials[0].kind).reflectance.is_textured());

  scene.textures = {Checkerboard{glm::vec3(0.1f), glm::vec3(0.9f)}};
  const NeedsResult detail = needs_of(scene, needs_plan_of({PartId::texture}));
  expect_need(detail, "texture of 'floor' → its mean", Need::needed);
  EXPECT_FALSE(detail.smallest);
}

TEST(Needs, WhatIsLitThroughGlassNeedsIt) {
  Scene scene = one_bounce();
  // Around the lamp: all light comes through it.
  add_shape(scene, Sphere{.center = {0, 2, 0}, .radius = 0.9f}, glass(1.5f)).id = "bulb";
  NeedsPlan plan = needs_plan_of({PartId::gloss});
  plan.spp = 32;
  const NeedsResult result = needs_of(scene, plan);
  expect_need(result, "'bulb' dielectric → diffuse", Need::needed);
  EXPECT_LT(row_called(result, "'bulb' dielectric → diffuse").measured.energy.high, -0.2);
}

TEST(Needs, AMetalOutOfSightIsNotNeeded) {
  Scene scene = one_bounce();
  add_shape(scene, Sphere{.center = {0, -2, 0}, .radius = 0.5f}, perfect_mirror()).id = "hidden";
  const NeedsResult result = needs_of(scene, needs_plan_of({PartId::gloss}));
  expect_need(result, "'hidden' conductor → diffuse", Need::not_needed);
}

TEST(Needs, ALensIsNeededOutOfFocusOnly) {
  Scene scene = one_bounce(textured_diffuse());
  scene.textures = {Checkerboard{glm::vec3(0.1f), glm::vec3(0.9f)}};
  scene.camera.focus_distance = 4.1f;
  scene.camera.aperture_radius = 1e-6f;
  NeedsPlan plan = needs_plan_of({PartId::lens});
  expect_need(needs_of(scene, plan), "lens → pinhole", Need::not_needed);
  scene.camera.aperture_radius = 0.5f;
  scene.camera.focus_distance = 1.0f;
  expect_need(needs_of(scene, plan), "lens → pinhole", Need::needed);
}

TEST(Needs, SmoothNormalsOfAFlatMeshAreNotNeeded) {
  Scene scene = one_bounce();
  Mesh& floor = std::get<Mesh>(scene.shapes[0].geometry);
  floor.normals.assign(4, glm::vec3(0.0f, 1.0f, 0.0f));
  expect_need(needs_of(scene, needs_plan_of({PartId::normals})), "'floor' smooth → flat",
              Need::not_needed);
  floor.normals[0] = floor.normals[1] = glm::normalize(glm::vec3(0.7f, 1.0f, 0.0f));
  expect_need(needs_of(scene, needs_plan_of({PartId::normals})), "'floor' smooth → flat",
              Need::needed);
}

TEST(Needs, NextEventPaysForASmallLampAndIsNoMatterOfError) {
  NeedsPlan plan = needs_plan_of({PartId::next_event, PartId::roulette});
  const NeedsResult result = needs_of(one_bounce(), plan);
  const NeedsRow& row = row_called(result, "no next-event estimation");
  EXPECT_EQ(int(row.need), int(Need::needed));
  EXPECT_LT(row.rays_ratio, 1.0);
  EXPECT_GT(row.measured.variance.low, 5.0);
  EXPECT_TRUE(row.measured.error.contains(0.0)) << row.measured.error.low;
  EXPECT_TRUE(row.measured.energy.contains(0.0));
  EXPECT_TRUE(result.taken_out.empty());
}

TEST(Needs, NextEventDoesNotPayUnderAnEvenSky) {
  // A floor's own cosine finds all light there is, without noise.
  Scene scene = one_bounce();
  scene.shapes.pop_back();
  scene.environment = ConstantEnvironment{glm::vec3(1.0f)};
  const NeedsResult result = needs_of(scene, needs_plan_of({PartId::next_event}));
  const NeedsRow& row = result.rows.front();
  EXPECT_LT(row.cost().high, 1.0) << row.rays_ratio << ", " << row.measured.variance.mean;
  EXPECT_EQ(result.smallest_model.integrator, IntegratorId::kajiya);
}

TEST(Needs, TheSmallestModelIsMeasuredAsAWhole) {
  // A third of the light is a ninth of the squared error, and two thirds are four ninths, of the
  // half of the picture that the floor takes: errors of two that may go would add up to less than
  // is allowed, and both together are more.
  Scene scene = one_bounce();
  scene.shapes.pop_back();
  for (const float x : {-0.9f, -0.3f, 0.3f}) {
    add_light(scene, parallelogram({x, 2, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}), 500.0f);
  }
  NeedsPlan plan = needs_plan_of({PartId::depth, PartId::light});
  plan.error = 0.15;
  const NeedsResult result = needs_of(scene, plan);
  for (const std::string light : {"mesh 2 dark", "mesh 3 dark", "mesh 4 dark"}) {
    expect_need(result, light, Need::not_needed);
    EXPECT_NEAR(row_called(result, light).measured.error.mean, 0.5 / 9.0, 0.02);
  }
  ASSERT_EQ(result.taken_out.size(), 2u) << "the depth, and one of the lights";
  ASSERT_TRUE(result.smallest);
  EXPECT_LE(result.smallest->measured.error.high, 0.15);
  EXPECT_NEAR(result.smallest->measured.error.mean, 0.5 / 9.0, 0.02);
  EXPECT_EQ(result.smallest_model.scene.max_depth, 2);
  EXPECT_EQ(std::ranges::count(result.smallest_model.scene.shapes, true, &Shape::emits), 2);
}

TEST(Needs, SaysWhenTheWholeModelIsTooNoisy) {
  NeedsPlan plan = needs_plan_of({PartId::depth});
  plan.error = 1e-9;
  const Scene scene = one_bounce();
  const auto result = run_needs(model_of(scene, default_settings(scene)), 1, plan, {}, {});
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->can_be_met);
  EXPECT_TRUE(result->rows.empty());
}

TEST(Needs, EndsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  const Scene scene = one_bounce();
  EXPECT_FALSE(run_needs(model_of(scene, default_settings(scene)), 1,
                         needs_plan_of({PartId::depth}), stop.get_token(), {}));
}

TEST(ModelParts, EveryPartOfABuiltinSceneCanBeTakenOut) {
  for (const std::string& name : builtin_scenes()) {
    const Scene scene = load_scene(find_scene(name));
    const Model whole = model_of(scene, default_settings(scene));
    for (const Part& row : parts()) {
      for (const Simplification& each : row.of(whole)) {
        SCOPED_TRACE(name + ", " + each.label);
        Model model = simplified(whole, std::span(&each, 1));
        model.scene.width = 8;
        model.scene.height = 6;
        const auto pictures = render_model(model, 1, 0, 1, {}, [](double) {});
        ASSERT_TRUE(pictures);
        EXPECT_GT(pictures->rays, 0.0);
      }
    }
  }
}

}  // namespace
}  // namespace quartet
