#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "renderer/files/exr.h"
#include "renderer/files/png.h"
#include "renderer/measure/reference/reference_sums.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

class ReferenceCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  Result reference(const std::string& name, std::vector<std::string> more,
                   const std::string& scene = "cornell-box") const {
    std::vector<std::string> words{"reference", scene, "--size", "20x15", "-o", path(name)};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }

  /// Exit code 1, one line with `reason`, and the file as it was.
  void expect_refused(const std::string& name, const std::vector<std::string>& more,
                      const std::string& reason, const std::string& scene = "cornell-box") const {
    SCOPED_TRACE(reason);
    const std::string before = bytes_of(path(name));
    const Result result = reference(name, more, scene);
    EXPECT_EQ(result.code, 1);
    EXPECT_NE(result.error.find(reason), std::string::npos) << result.error;
    EXPECT_EQ(std::ranges::count(result.error, '\n'), 1) << result.error;
    EXPECT_EQ(bytes_of(path(name)), before);
  }

  TempFolder folder_;
};

using CompareCommand = ReferenceCommand;

void write_picture(const std::filesystem::path& path, const RadianceImage& image,
                   bool half = false) {
  ExrImage exr(image.width(), image.height());
  exr.add_radiance(image);
  for (ExrChannel& channel : exr.channels) {
    channel.half = half;
  }
  std::ranges::reverse(exr.channels);
  write_exr(path, exr);
}

TEST_F(ReferenceCommand, AddsToItsFileAndEndsAsIfMadeAtOnce) {
  ASSERT_EQ(reference("once.exr", {"--spp", "20"}).code, 0);
  ASSERT_EQ(reference("twice.exr", {"--spp", "7"}).code, 0);
  const Result result = reference("twice.exr", {"--spp", "20"});
  ASSERT_EQ(result.code, 0) << result.error;
  EXPECT_NE(result.out.find("20 spp, 13 of them new"), std::string::npos) << result.out;
  const ExrImage once = read_exr(path("once.exr"));
  const ExrImage twice = read_exr(path("twice.exr"));
  ASSERT_EQ(once.channels.size(), twice.channels.size());
  for (std::size_t i = 0; i < once.channels.size(); ++i) {
    EXPECT_EQ(once.channels[i].name, twice.channels[i].name);
    EXPECT_TRUE(once.channels[i].pixels == twice.channels[i].pixels) << once.channels[i].name;
  }
  EXPECT_EQ(once.attributes.at("noiseFloor"), twice.attributes.at("noiseFloor"));
  EXPECT_EQ(once.attributes.at("spp"), "20");
  EXPECT_EQ(once.attributes.at("seed"), std::to_string(reference_seed));

  const std::string before = bytes_of(path("twice.exr"));
  const Result again = reference("twice.exr", {"--spp", "20"});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.out.find("0 of them new"), std::string::npos) << again.out;
  EXPECT_EQ(bytes_of(path("twice.exr")), before);
  EXPECT_EQ(names_in(folder_.path()), (std::set<std::string>{"once.exr", "twice.exr"}));
}

TEST_F(ReferenceCommand, DoesNotDependOnTheNumberOfThreads) {
  ASSERT_EQ(reference("1.exr", {"--spp", "9", "--threads", "1"}).code, 0);
  ASSERT_EQ(reference("4.exr", {"--spp", "9", "--threads", "4"}).code, 0);
  const ExrImage one = read_exr(path("1.exr"));
  const ExrImage four = read_exr(path("4.exr"));
  for (std::size_t i = 0; i < one.channels.size(); ++i) {
    EXPECT_TRUE(one.channels[i].pixels == four.channels[i].pixels) << one.channels[i].name;
  }
}

TEST_F(ReferenceCommand, EndsAfterItsSecondsAtLeastOnePass) {
  ASSERT_EQ(reference("a.exr", {"--seconds", "0.001"}).code, 0);
  const std::uint64_t first = sums_of(read_exr(path("a.exr")), "a.exr")->spp;
  EXPECT_GE(first, 2u);
  ASSERT_EQ(reference("a.exr", {"--seconds", "0.001"}).code, 0);
  EXPECT_GT(sums_of(read_exr(path("a.exr")), "a.exr")->spp, first) << "adds more time";
  // The first of two ends that is met.
  ASSERT_EQ(reference("b.exr", {"--seconds", "1000", "--spp", "3"}).code, 0);
  EXPECT_EQ(sums_of(read_exr(path("b.exr")), "b.exr")->spp, 3u);
}

TEST_F(ReferenceCommand, GoesOnWithNothingElse) {
  ASSERT_EQ(reference("a.exr", {"--spp", "2"}).code, 0);
  expect_refused("a.exr", {"--spp", "4"}, "'cornell-box' as of hash", "furnace");
  expect_refused("a.exr", {"--spp", "4", "--seed", "7"}, "seed");
  expect_refused("a.exr", {"--spp", "4", "--integrator", "kajiya"}, "made with mis, not kajiya");
  expect_refused("a.exr", {"--spp", "4", "--sampler", "independent"},
                 "made with the sampler sobol, not independent");
  expect_refused("a.exr", {"--spp", "4", "--max-depth", "3"}, "depth");
  expect_refused("a.exr", {"--spp", "4", "--camera", "0,1,5,1,0,0,0,1,0,0,0,-1"}, "camera");
  write_picture(path("picture.exr"), RadianceImage(20, 15, glm::vec3(0.5f)));
  expect_refused("picture.exr", {"--spp", "4"}, "no reference of Quartet's");
  write_bytes_to(path("text.exr"), "not a picture");
  expect_refused("text.exr", {"--spp", "4"}, "text.exr as EXR");
  EXPECT_EQ(reference("picture.exr", {"--spp", "4", "--restart"}).code, 0);
  EXPECT_TRUE(sums_of(read_exr(path("picture.exr")), "picture.exr").has_value());
}

TEST_F(ReferenceCommand, WrongUsage) {
  const std::vector<std::string> words{"reference", "cornell-box", "-o", path("a.exr")};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return more;
  };
  expect_usage_error(words, "give --spp");
  for (const char* spp : {"0", "1", "-3", "many", "1e99"}) {
    expect_usage_error(with({"--spp", spp}), "--spp");
  }
  for (const char* seconds : {"0", "-1", "nan", "inf"}) {
    expect_usage_error(with({"--seconds", seconds}), "--seconds");
  }
  expect_usage_error({"reference", "cornell-box", "--spp", "4", "-o", "a.png"}, "no .exr");
  expect_usage_error(with({"--spp", "4", "--size", "6000x3000"}), "14 million pixels");
  EXPECT_EQ(names_in(folder_.path()), std::set<std::string>());
}

TEST_F(CompareCommand, PrintsEveryMetricAsTextAndAsJson) {
  RadianceImage test(20, 15, glm::vec3(0.5f));
  RadianceImage truth = test;
  test.at(3, 4) = glm::vec3(0.75f);
  write_picture(path("test.exr"), test, true);
  write_picture(path("truth.exr"), truth);
  const Result text = run({"compare", path("test.exr"), path("truth.exr")});
  ASSERT_EQ(text.code, 0) << text.error;
  const Result result = run({"compare", path("test.exr"), path("truth.exr"), "--json"});
  ASSERT_EQ(result.code, 0) << result.error;
  const auto json = nlohmann::json::parse(result.out);
  for (const Metric& row : metrics()) {
    EXPECT_NE(text.out.find(row.id), std::string::npos) << row.id;
    EXPECT_DOUBLE_EQ(json.at("metrics").at(row.id).get<double>(), row.compute(test, truth))
        << row.id;
    EXPECT_TRUE(json.at("noise_floor").at(row.id).is_null()) << "another program's picture";
  }
  EXPECT_DOUBLE_EQ(json.at("metrics").at("mse").get<double>(), 0.0625 / 300.0);
  EXPECT_TRUE(json.at("metrics").at("efficiency").is_null()) << "nobody knows its seconds";
  EXPECT_DOUBLE_EQ(json.at("reference_mean").at(1).get<double>(), 0.5);
  EXPECT_NE(text.out.find("no reference of Quartet's"), std::string::npos);
}

TEST_F(CompareCommand, EveryNumberOfItsJsonStandsUnderItsName) {
  RadianceImage test(2, 1);
  test.pixels()[0] = {0.25f, 0.5f, 0.75f};
  test.pixels()[1] = {0.5f, 1.0f, 1.25f};
  RadianceImage truth(2, 1);
  truth.pixels()[0] = {0.0f, 0.25f, 0.5f};
  truth.pixels()[1] = {0.25f, 0.5f, 1.0f};
  ExrImage timed(2, 1);
  timed.add_radiance(test);
  timed.attributes = {{"seconds", "2.5"}, {"samples", "7"}};
  write_exr(path("test.exr"), timed);
  write_picture(path("truth.exr"), truth);
  const auto json =
      nlohmann::json::parse(run({"compare", path("test.exr"), path("truth.exr"), "--json"}).out);
  EXPECT_EQ(json.at("test"), path("test.exr"));
  EXPECT_EQ(json.at("reference"), path("truth.exr"));
  EXPECT_EQ(json.at("width"), 2);
  EXPECT_EQ(json.at("height"), 1);
  EXPECT_EQ(json.at("test_mean"), nlohmann::json({0.375, 0.75, 1.0}));
  EXPECT_EQ(json.at("reference_mean"), nlohmann::json({0.125, 0.375, 0.75}));
  EXPECT_EQ(json.at("seconds"), 2.5);
  const double mse = (5 * 0.0625 + 0.25) / 6.0;
  EXPECT_DOUBLE_EQ(json.at("metrics").at("mse").get<double>(), mse);
  EXPECT_DOUBLE_EQ(json.at("metrics").at("rmse").get<double>(), std::sqrt(mse));
  EXPECT_DOUBLE_EQ(json.at("metrics").at("efficiency").get<double>(), 1.0 / (mse * 2.5));
  for (const Metric& row : metrics()) {
    EXPECT_DOUBLE_EQ(json.at("metrics").at(row.id).get<double>(), row.compute(test, truth))
        << row.id;
  }

  // Against a reference of ours, whose noise is known.
  ASSERT_EQ(reference("ref.exr", {"--spp", "8"}).code, 0);
  const Reference ours = reference_of(*sums_of(read_exr(path("ref.exr")), "ref.exr"));
  write_picture(path("even.exr"), RadianceImage(20, 15, glm::vec3(0.5f)));
  const auto known =
      nlohmann::json::parse(run({"compare", path("even.exr"), path("ref.exr"), "--json"}).out);
  for (const Metric& row : metrics()) {
    EXPECT_DOUBLE_EQ(known.at("noise_floor").at(row.id).get<double>(), ours.noise_floor(row.key))
        << row.id;
  }
}

TEST_F(CompareCommand, OfAPictureWithItself) {
  write_picture(path("a.exr"), RadianceImage(20, 15, glm::vec3(0.5f)));
  const Result result = run({"compare", path("a.exr"), path("a.exr"), "--json"});
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("metrics").at("flip").get<double>(), 0.0);
  EXPECT_TRUE(json.at("metrics").at("psnr").is_null()) << "JSON has no infinity";
  EXPECT_NE(run({"compare", path("a.exr"), path("a.exr")}).out.find("inf"), std::string::npos);
}

TEST_F(CompareCommand, KnowsTheNoiseOfAReferenceAndTheTimeOfARender) {
  ASSERT_EQ(reference("ref.exr", {"--spp", "64"}).code, 0);
  ASSERT_EQ(
      run({"render", "cornell-box", "--size", "20x15", "--spp", "4", "-o", path("a.exr")}).code, 0);
  const auto json =
      nlohmann::json::parse(run({"compare", path("a.exr"), path("ref.exr"), "--json"}).out);
  const double mse = json.at("metrics").at("mse").get<double>();
  const double floor = json.at("noise_floor").at("mse").get<double>();
  EXPECT_GT(floor, 0.0);
  EXPECT_LT(floor, mse) << "64 samples against 4";
  const double seconds = json.at("seconds").get<double>();
  EXPECT_DOUBLE_EQ(json.at("metrics").at("efficiency").get<double>(), 1.0 / (mse * seconds));
}

TEST_F(CompareCommand, WritesWhereTheErrorIs) {
  RadianceImage test(20, 15, glm::vec3(0.5f));
  write_picture(path("truth.exr"), test);
  test.at(3, 4) = glm::vec3(0.75f);
  write_picture(path("test.exr"), test);
  for (const Metric& row : metrics()) {
    const std::string picture = path(std::string(row.id) + ".png");
    const Result result = run({"compare", path("test.exr"), path("truth.exr"), "--picture", picture,
                               "--metric", std::string(row.id)});
    ASSERT_EQ(result.code, 0) << result.error;
    EXPECT_EQ(bytes_of(picture).substr(1, 3), "PNG");
  }
}

TEST_F(CompareCommand, SaysWhatCannotBeCompared) {
  write_picture(path("a.exr"), RadianceImage(20, 15, glm::vec3(0.5f)));
  write_picture(path("small.exr"), RadianceImage(10, 15, glm::vec3(0.5f)));
  ExrImage cropped(20, 15);
  cropped.add_radiance(RadianceImage(20, 15, glm::vec3(0.5f)));
  cropped.display = {0, 0, 21, 15};
  write_exr(path("cropped.exr"), cropped);
  ExrImage depth(20, 15);
  depth.add("Z", std::vector<float>(300, 0.5f));
  write_exr(path("depth.exr"), depth);
  const auto expect_failure = [&](const std::string& test, const std::string& truth,
                                  const std::vector<std::string>& parts) {
    const std::string picture = path("error.png");
    const Result result = run({"compare", path(test), path(truth), "--json", "--picture", picture});
    EXPECT_EQ(result.code, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::ranges::count(result.error, '\n'), 1) << result.error;
    for (const std::string& part : parts) {
      EXPECT_NE(result.error.find(part), std::string::npos) << result.error;
    }
    EXPECT_FALSE(std::filesystem::exists(picture));
  };
  expect_failure("small.exr", "a.exr", {"small.exr has 10x15", "a.exr has 20x15"});
  expect_failure("cropped.exr", "a.exr", {"cropped.exr", "20x15", "21x15"});
  expect_failure("depth.exr", "a.exr", {"depth.exr", "its layers: unnamed (Z)"});
  expect_failure("a.exr", "none.exr", {"none.exr"});
  expect_usage_error({"compare", path("a.exr"), path("a.exr"), "--metric", "ssim"},
                     "there are: mse, rmse");
  expect_usage_error({"compare", path("a.exr"), path("a.exr"), "--picture", "a.jpg"}, "no .png");
  expect_usage_error({"compare", path("a.exr")}, "reference");
}

}  // namespace
}  // namespace quartet
