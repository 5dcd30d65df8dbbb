#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "renderer/files/exr.h"
#include "renderer/files/png.h"
#include "renderer/measure/reference/reference.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

class StopOptions : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::vector<std::string> with(std::vector<std::string> words,
                                const std::vector<std::string>& more) const {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  void make_reference() const {
    const Result result =
        run({"reference", "cornell-box", "--size", "20x15", "--spp", "256", "-o", path("ref.exr")});
    ASSERT_EQ(result.code, 0) << result.error;
  }

  /// Passes that a render takes.
  std::uint64_t passes(const std::vector<std::string>& more) const {
    const Result result =
        run(with({"render", "cornell-box", "--size", "20x15", "-o", path("a.exr")}, more));
    EXPECT_EQ(result.code, 0) << result.error;
    const auto settings = nlohmann::json::parse(read_exr(path("a.exr")).attributes.at("settings"));
    return settings.at("passes").get<std::uint64_t>();
  }

  TempFolder folder_;
};

TEST_F(StopOptions, RenderStopsAtTheFirstCondition) {
  make_reference();
  EXPECT_EQ(passes({}), 15u);
  EXPECT_EQ(passes({"--passes", "4"}), 4u);
  EXPECT_EQ(passes({"--spp", "6"}), 6u) << "a sample a pass";
  EXPECT_EQ(passes({"--spp", "5.5"}), 6u);
  EXPECT_EQ(passes({"--spp", "6", "--passes", "4"}), 4u);
  EXPECT_EQ(passes({"--spp", "3", "--passes", "4", "--seconds", "1000"}), 3u);
  EXPECT_EQ(passes({"--seconds", "1e-9", "--passes", "50"}), 1u);
  // A sample takes at least the ray from the camera, and here some four more.
  EXPECT_EQ(passes({"--rays", "1", "--passes", "50"}), 1u);
  const std::uint64_t by_rays = passes({"--rays", "60", "--passes", "50"});
  EXPECT_GT(by_rays, 4u);
  EXPECT_LT(by_rays, 40u);
  // The error of each pass, as compare measures it, says where it should have stopped.
  const std::uint64_t stopped =
      passes({"--error", "relmse=0.05", "--passes", "500", "--reference", path("ref.exr")});
  EXPECT_GT(stopped, 1u);
  EXPECT_LT(stopped, 500u);
  const auto relmse = [&](std::uint64_t count) {
    EXPECT_EQ(passes({"--passes", std::to_string(count)}), count);
    return metric(MetricId::relmse)
        .compute(radiance_of(read_exr(path("a.exr")), "a.exr"),
                 load_reference(path("ref.exr"))->image);
  };
  EXPECT_LE(relmse(stopped), 0.05);
  EXPECT_GT(relmse(stopped - 1), 0.05);
  EXPECT_EQ(passes({"--error", "relmse=1e-9", "--passes", "5", "--reference", path("ref.exr")}),
            5u);
}

TEST_F(StopOptions, FramesIsAnotherNameOfPasses) {
  EXPECT_EQ(passes({"--frames", "4"}), 4u);
  for (const char* command : {"render", "figure", "screenshot", "sweep", "calibrate", "bias"}) {
    const Result result = run({command, "cornell-box", "--frames", "0"});
    EXPECT_EQ(result.code, 2) << command;
    EXPECT_NE(result.error.find("--passes: '0' is not"), std::string::npos) << result.error;
  }
  const Result claims = run({"claims", "--frames", "0"});
  EXPECT_NE(claims.error.find("--passes: '0' is not"), std::string::npos) << claims.error;
}

TEST_F(StopOptions, EachLaneOfAFigureHasAnEndOfItsOwn) {
  make_reference();
  const Result result =
      run({"figure", "cornell-box", "--size", "20x15", "--spp", "12", "--estimators",
           "uniform,kl,contrast", "--reference", path("ref.exr"), "--out", path("out")});
  ASSERT_EQ(result.code, 0) << result.error;
  const auto json = nlohmann::json::parse(bytes_of(path("out/panels.json")));
  ASSERT_EQ(json.at("lanes").size(), 3u);
  EXPECT_EQ(json.at("reference").at("spp").get<int>(), 256);
  EXPECT_GT(json.at("reference").at("noise_floor").at("mse").get<double>(), 0.0);
  const std::string csv = bytes_of(path("out/panels.csv"));
  for (const auto& lane : json.at("lanes")) {
    const auto id = lane.at("estimator").get<std::string>();
    const auto& history = lane.at("history");
    EXPECT_GE(history.back().at("mean_spp").get<double>(), 12.0) << id;
    EXPECT_LT(history[history.size() - 2].at("mean_spp").get<double>(), 12.0) << id;
    // The lane alone gives the same picture.
    const Result alone =
        run({"render", "cornell-box", "--size", "20x15", "--spp", "12", "--estimator", id,
             "--reference", path("ref.exr"), "-o", path("alone.exr")});
    ASSERT_EQ(alone.code, 0) << alone.error;
    const ExrImage panel = read_exr(path("out/" + id + ".exr"));
    const ExrImage other = read_exr(path("alone.exr"));
    ASSERT_NE(panel.find("SquaredError"), nullptr);
    for (const char* name : {"R", "G", "B", "SampleCount", "SquaredError"}) {
      EXPECT_TRUE(panel.find(name)->pixels == other.find(name)->pixels) << id << " " << name;
    }
    double squared = 0.0;
    for (const float error : std::get<std::vector<float>>(panel.find("SquaredError")->pixels)) {
      squared += error / 300.0;
    }
    const double mse = lane.at("metrics").at("mse").get<double>();
    EXPECT_NEAR(squared, mse, 1e-5 * mse) << id;
    // Every metric and the efficiency, of the last pass alone.
    std::istringstream lines(csv);
    std::size_t rows = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("cornell-box,sobol," + id + ",") &&
          (line.find(",relmse,") != std::string::npos ||
           line.find(",efficiency,") != std::string::npos)) {
        ++rows;
      }
    }
    EXPECT_EQ(rows, 2u) << id;
  }
  EXPECT_EQ(json.at("lanes")[0].at("history").size(), 12u);
  EXPECT_LT(json.at("lanes")[2].at("history").size(), 12u) << "contrast takes more a pass";
}

TEST_F(StopOptions, AScreenshotShowsAllLanesWhereTheLastOneEnds) {
  make_reference();
  const std::vector<std::vector<std::string>> conditions{
      {"--spp", "12"}, {"--error", "relmse=0.1", "--reference", path("ref.exr")}};
  for (const std::vector<std::string>& condition : conditions) {
    SCOPED_TRACE(condition.front());
    const Result figure = run(with({"figure", "cornell-box", "--size", "20x15", "--estimators",
                                    "uniform,kl,contrast", "--out", path("out")},
                                   condition));
    ASSERT_EQ(figure.code, 0) << figure.error;
    std::size_t last = 0;
    const auto json = nlohmann::json::parse(bytes_of(path("out/panels.json")));
    for (const auto& lane : json.at("lanes")) {
      last = std::max(last, lane.at("history").back().at("pass").get<std::size_t>());
    }
    ASSERT_GT(last, 2u);
    // Of the lanes' pictures and heatmaps: times differ from run to run.
    const auto pictures = [&](const std::vector<std::string>& more) {
      const Result shot =
          run(with({"screenshot", "cornell-box", "--render-size", "20x15", "--estimators",
                    "uniform,kl,contrast", "--size", "1280x720", "-o", path("shot.png")},
                   more));
      EXPECT_EQ(shot.code, 0) << shot.error;
      const DisplayImage image = read_png(path("shot.png"));
      std::vector<Rgba8> inside;
      for (int y = 200; y < 380; ++y) {
        for (int x = 0; x < image.width(); ++x) {
          inside.push_back(image.at(x, y));
        }
      }
      return inside;
    };
    const auto of_pass = [&](std::size_t pass) {
      std::vector<std::string> words{"--passes", std::to_string(pass)};
      if (condition.size() > 2) {  // the dock takes the same room
        words.insert(words.end(), {"--reference", path("ref.exr")});
      }
      return pictures(words);
    };
    const std::vector<Rgba8> found = pictures(condition);
    EXPECT_EQ(found, of_pass(last));
    EXPECT_NE(found, of_pass(last - 1));
  }
}

TEST_F(StopOptions, WrongUsageOfEveryCommandThatHasThem) {
  const std::vector<std::vector<std::string>> commands{
      {"render", "cornell-box", "--size", "20x15", "-o", path("a.exr")},
      {"figure", "cornell-box", "--size", "20x15", "--out", path("out")},
      {"screenshot", "cornell-box", "--render-size", "20x15", "-o", path("a.png")}};
  for (const auto& command : commands) {
    SCOPED_TRACE(command.front());
    for (const char* option : {"--passes", "--spp", "--seconds"}) {
      for (const char* value : {"0", "-1", "nan", "many"}) {
        expect_usage_error(with(command, {option, value}), option);
      }
    }
    expect_usage_error(with(command, {"--error", "relmse=0.1"}), "needs --reference");
    for (const char* target : {"ssim=0.1", "relmse"}) {
      expect_usage_error(with(command, {"--error", target, "--reference", "ref.exr"}),
                         "relmse_trimmed");
    }
    for (const char* target : {"relmse=0", "relmse=-1", "relmse=nan", "relmse=x"}) {
      expect_usage_error(with(command, {"--error", target, "--reference", "ref.exr"}),
                         "no number above 0");
    }
  }
  EXPECT_EQ(names_in(folder_.path()), std::set<std::string>());
}

TEST_F(StopOptions, AReferenceThatDoesNotFitIsRefused) {
  make_reference();
  RadianceImage bad(20, 15, glm::vec3(0.5f));
  ExrImage foreign(20, 15);
  foreign.add_radiance(bad);
  write_exr(path("foreign.exr"), foreign);
  bad.at(7, 8).b = std::numeric_limits<float>::infinity();
  ExrImage infinite(20, 15);
  infinite.add_radiance(bad);
  write_exr(path("infinite.exr"), infinite);
  const auto expect_failure = [&](const std::vector<std::string>& more, const std::string& part) {
    SCOPED_TRACE(part);
    const Result result = run(with({"render", "cornell-box", "-o", path("a.exr")}, more));
    EXPECT_EQ(result.code, 1);
    EXPECT_NE(result.error.find(part), std::string::npos) << result.error;
    EXPECT_EQ(std::ranges::count(result.error, '\n'), 1) << result.error;
    EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
  };
  const std::string ref = path("ref.exr");
  const std::vector<std::string> size{"--size", "20x15"};
  expect_failure({"--size", "40x30", "--reference", ref}, "20x15 pixels, the run has 40x30");
  expect_failure(with(size, {"--max-depth", "4", "--reference", ref}), "unlimited depth");
  expect_failure(with(size, {"--seed", std::to_string(reference_seed), "--reference", ref}),
                 "same random numbers");
  expect_failure(with(size, {"--reference", path("infinite.exr")}), "(7, 8)");
  expect_failure(with(size, {"--reference", path("none.exr")}), "none.exr");
  const Result furnace =
      run({"render", "furnace", "--size", "20x15", "-o", path("a.exr"), "--reference", ref});
  EXPECT_EQ(furnace.code, 1);
  EXPECT_NE(furnace.error.find("'cornell-box'"), std::string::npos) << furnace.error;
  // Another program's picture is taken, with a word of warning.
  const Result result = run(with({"render", "cornell-box", "-o", path("a.exr")},
                                 with(size, {"--reference", path("foreign.exr")})));
  EXPECT_EQ(result.code, 0) << result.error;
  EXPECT_NE(result.error.find("could not be checked"), std::string::npos) << result.error;
}

}  // namespace
}  // namespace quartet
