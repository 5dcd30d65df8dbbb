#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "renderer/files/exr.h"
#include "renderer/trace/sampler_row.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

/// A scene file with what `body` holds, under a point light.
std::string write_scene(const TempFolder& folder, const std::string& body) {
  std::string path = (folder.path() / "scene.xml").string();
  std::ofstream(path)
      << R"(<scene version="3.0.0"><sensor type="perspective"><float name="fov" value="40"/>
            <film type="hdrfilm"><integer name="width" value="8"/>
            <integer name="height" value="8"/></film></sensor><emitter type="point"/>)"
      << body << "</scene>";
  return path;
}

TEST(SceneOptions, AnIntegratorThatWouldMissALightIsRefusedByEveryCommand) {
  const TempFolder folder;
  const std::string scene = write_scene(folder, R"(<emitter type="constant"/>)");
  const std::string out = (folder.path() / "out").string();
  for (std::vector<std::string> words :
       std::vector<std::vector<std::string>>{{"render", scene, "-o", out + ".exr"},
                                             {"figure", scene, "--out", out},
                                             {"reference", scene, "--spp", "2", "-o", out + ".exr"},
                                             {"screenshot", scene, "-o", out + ".png"},
                                             {"sweep", scene, "--out", out},
                                             {"bias", scene, "--out", out},
                                             {"calibrate", scene, "--spp", "4"},
                                             {"trace", scene, "--pixel", "0,0"}}) {
    words.insert(words.end(), {"--integrator", "kajiya"});
    expect_usage_error(words,
                       "integrator kajiya cannot find point lights, and the scene 'scene' has 1");
  }
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"scene.xml"});
}

TEST(SceneOptions, TheSamplerStandsOnWhatIsMadeWithIt) {
  const TempFolder folder;
  const auto path = [&](const std::string& name) { return (folder.path() / name).string(); };
  std::vector<std::vector<float>> reds;
  for (const SamplerRow& row : samplers()) {
    SCOPED_TRACE(row.id);
    const std::string id(row.id);
    const Result render = run({"render", "furnace", "--size", "6x5", "--spp", "3", "--sampler", id,
                               "--estimator", "uniform", "-o", path(id + ".exr")});
    ASSERT_EQ(render.code, 0) << render.error;
    const ExrImage exr = read_exr(path(id + ".exr"));
    EXPECT_EQ(exr.attributes.at("sampler"), id);
    EXPECT_TRUE(exr.attributes.at("varianceMeaning").starts_with(row.variance_channel));
    ASSERT_TRUE(exr.find(std::string(row.variance_channel) + ".R"));
    reds.push_back(std::get<std::vector<float>>(exr.find("R")->pixels));
    const Result reference = run({"reference", "furnace", "--size", "6x5", "--spp", "2",
                                  "--sampler", id, "-o", path(id + "-ref.exr")});
    ASSERT_EQ(reference.code, 0) << reference.error;
    EXPECT_EQ(read_exr(path(id + "-ref.exr")).attributes.at("sampler"), id);
    const Result trace = run(
        {"trace", "furnace", "--size", "6x5", "--pixel", "2,2", "--index", "5", "--sampler", id});
    ASSERT_EQ(trace.code, 0) << trace.error;
    EXPECT_NE(trace.out.find("mis, " + id), std::string::npos) << trace.out;
    EXPECT_NE(run({"list"}).out.find("\n  " + id), std::string::npos);
  }
  EXPECT_NE(reds[0], reds[1]);
  EXPECT_NE(reds[0], reds[2]);
  EXPECT_NE(reds[1], reds[2]);
}

TEST(SceneOptions, CamerasOutOfRangeAreWrongUsage) {
  const TempFolder folder;
  const std::string exr = (folder.path() / "x.exr").string();
  const auto expect_refused = [&](const std::string& camera, const std::string& message) {
    expect_usage_error(
        {"render", "furnace", "--size", "4x4", "--spp", "1", "-o", exr, "--camera=" + camera},
        message);
  };
  const std::string axes = ",-1,0,0,0,1,0,0,0,-1";
  expect_refused("nan,0,0" + axes, "--camera: 'nan' is not a number from");
  expect_refused("0,2e9,0" + axes, "from -1000000000 to 1000000000");
  expect_refused("0,0,1e20" + axes, "--camera: origin is");
  expect_refused("0,0,0,-1,0,0,0,inf,0,0,0,-1", "--camera: 'inf' is not a number from");
  expect_refused("0,0,0,-1,0,0,0,2,0,0,0,-1", "must have length 1");
  expect_refused("0,0,0,-1,0,0,1,0,0,0,0,-1", "must be at right angles");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>());
}

TEST(SceneOptions, PicturesOutOfRangeAreWrongUsage) {
  expect_usage_error({"render", "furnace", "--size", "65537x1", "-o", "x.exr"},
                     "--size: a picture of 65537 x 1 pixels, each side must be from 1 to 65536");
  expect_usage_error(
      {"render", "furnace", "--size", "65536x65536", "-o", "x.exr"},
      "--size: a picture of 65536 x 65536 pixels, at most 268435456 pixels are possible");
}

TEST(SceneOptions, WhatASceneSaysCannotSteerTheTerminal) {
  const TempFolder folder;
  const std::string scene =
      write_scene(folder, "<shape type=\"&#27;[2J\"/><shape type=\"cube\" id=\"\x1b[31m\"/>");
  const auto expect_safe = [](const std::string& text) {
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
    EXPECT_NE(text.find("\\x1b["), std::string::npos) << text;
  };
  expect_safe(run({"info", scene}).out);
  const std::string exr = (folder.path() / "x.exr").string();
  const Result rendered = run({"render", scene, "--spp", "1", "-o", exr});
  EXPECT_EQ(rendered.code, 0);
  expect_safe(rendered.error);
  expect_safe(run({"render", "no\x1b[31mscene", "--spp", "1", "-o", exr}).error);
  expect_safe(run({"render", scene, "--spp", "1", "-o", exr, "-D", "\x1b[31m=1"}).error);
  expect_safe(run({"render", scene, "-o", exr, "--\x1b[31m"}).error);
}

}  // namespace
}  // namespace quartet
