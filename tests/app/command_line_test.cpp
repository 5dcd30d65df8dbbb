#include "app/commands/command_line.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "renderer/adaptive/estimators/estimator.h"
#include "renderer/files/exr.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

TEST(CommandLine, WrongUsageIsOneLineAndCodeTwo) {
  const TempFolder folder;
  const std::string out = (folder.path() / "out").string();
  const auto figure = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"figure", "cornell-box", "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  expect_usage_error(figure({"--estimators", "kl,nonsense"}),
                     "unknown estimator 'nonsense'; there are: contrast, kl");
  expect_usage_error(figure({"--estimators", "kl,kl"}), "'kl' is named twice");
  expect_usage_error(figure({"--size", "0x540"}), "--size: '0x540' is not a size");
  expect_usage_error(figure({"--size", "960"}), "such as 960x540");
  expect_usage_error(figure({"--size", "960x540x3"}), "'960x540x3' is not a size");
  expect_usage_error(figure({"--size", "-5x5"}), "is not a size");
  expect_usage_error(figure({"--size", "65536x4096"}), "GiB of memory");
  expect_usage_error(figure({"--passes", "0"}), "--passes");
  expect_usage_error(figure({"--passes", "many"}), "--passes");
  expect_usage_error(figure({"--integrator", "bidir"}), "there are: kajiya, mis");
  expect_usage_error(figure({"--sampler", "halton"}), "there are: sobol, independent, replicated");
  expect_usage_error(figure({"--policy", "dice"}), "there are: vote");
  expect_usage_error(figure({"--tone-map", "gamma"}), "there are: clamp");
  expect_usage_error(figure({"--heat", "hot"}), "there are: linked, report");
  expect_usage_error(figure({"--multiplier", "-1"}), "--multiplier");
  expect_usage_error(figure({"--multiplier", "nan"}), "--multiplier");
  expect_usage_error(figure({"--threads", "-1"}), "--threads");
  expect_usage_error(figure({"--seed", "x"}), "--seed");
  expect_usage_error(figure({"--max-spp", "0"}), "--max-spp");
  expect_usage_error(figure({"-D", "novalue"}), "write name=value");
  expect_usage_error(figure({"-D", "a=1", "-D", "a=2"}), "-D: 'a' is given twice");
  expect_usage_error({"figure", "cornell-box"}, "--out");

  const std::string exr = (folder.path() / "x.exr").string();
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"render", "cornell-box", "-o", exr};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  expect_usage_error(render({"--threshold", "0.1"}), "estimator 'uniform' has none");
  expect_usage_error(render({"--estimator", "kl", "--threshold", "1,2"}), "takes 1");
  expect_usage_error(render({"--estimator", "kl", "--threshold", "0"}), "--threshold");
  expect_usage_error(render({"--estimator", "kl", "--threshold", "nan"}), "--threshold");
  expect_usage_error(render({"--spp", "0"}), "--spp");
  expect_usage_error({"render", "cornell-box", "-o", "picture.jpg"}, "neither .exr nor .png");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>());
}

TEST(CommandLine, AnUnknownCommandIsToldWhichOnesThereAre) {
  const std::string start = "'paint' is neither a command (figure, render, ";
  expect_usage_error({"paint"}, start);
  expect_usage_error({"paint", "cornell-box"}, start);
  expect_usage_error({"paint", "cornell-box", "--out", "out"}, start);
  expect_usage_error({"paint"}, "nor a scene; scenes are Mitsuba 3 XML files and cornell-box, ");
  // The scene is known: it is the option that is not.
  expect_usage_error({"cornell-box", "--out", "out"}, "not expected");
}

TEST(CommandLine, FailureIsOneLineAndCodeOne) {
  const TempFolder folder;
  const std::string missing = (folder.path() / "missing.xml").string();
  Result result = run({"render", missing, "-o", (folder.path() / "x.exr").string()});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.error.find("missing.xml"), std::string::npos) << result.error;
  EXPECT_NE(result.error.find("cornell-checker"), std::string::npos) << "lists what there is";
  EXPECT_EQ(std::ranges::count(result.error, '\n'), 1);

  // A file stands where the folder should be.
  const std::filesystem::path file = folder.path() / "file";
  std::ofstream(file) << "text";
  result = run({"figure", "cornell-box", "--size", "8x8", "--out", (file / "out").string()});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(std::ranges::count(result.error, '\n'), 1) << result.error;
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"file"});
}

TEST(CommandLine, FigureWritesAllItsFiles) {
  const TempFolder folder;
  const std::filesystem::path out = folder.path() / "new" / "out";
  const Result result = run({"figure", "cornell-checker", "--size", "32x18", "--passes", "3",
                             "--seed", "7", "--out", out.string()});
  ASSERT_EQ(result.code, 0) << result.error;
  EXPECT_EQ(names_in(out),
            (std::set<std::string>{
                "images.png", "images.pdf", "heatmaps.png", "heatmaps.pdf", "contrast.exr",
                "contrast.png", "contrast-heatmap.png", "kl.exr", "kl.png", "kl-heatmap.png",
                "chi2.exr", "chi2.png", "chi2-heatmap.png", "hellinger.exr", "hellinger.png",
                "hellinger-heatmap.png", "panels.csv", "panels.json", "quartet-files.txt"}));
  const auto json = nlohmann::json::parse(bytes_of(out / "panels.json"));
  EXPECT_EQ(json.at("settings").at("seed"), 7);
  EXPECT_EQ(json.at("settings").at("width"), 32);
  ASSERT_EQ(json.at("lanes").size(), 4u);
  EXPECT_NE(json.at("command_line").get<std::string>().find("--seed 7"), std::string::npos);
  for (const auto& lane : json.at("lanes")) {
    EXPECT_EQ(lane.at("history").size(), 3u);
    // Panels, table and EXR tell the same.
    const std::filesystem::path path = out / (lane.at("estimator").get<std::string>() + ".exr");
    const ExrImage exr = read_exr(path);
    EXPECT_EQ(exr.attributes.at("samples"),
              std::to_string(lane.at("history").back().at("samples").get<std::uint64_t>()));
    EXPECT_EQ(exr.attributes.at("seed"), "7");
    const auto& counts = std::get<std::vector<float>>(exr.find("SampleCount")->pixels);
    EXPECT_EQ(*std::ranges::max_element(counts), lane.at("history").back().at("max_spp"));
    EXPECT_NE(exr.find("VarianceIfIndependent.R"), nullptr);
    EXPECT_NE(exr.find("Rejected"), nullptr);
  }
  EXPECT_NE(read_exr(out / "kl.exr").find("Error.kl"), nullptr);
  EXPECT_NE(read_exr(out / "contrast.exr").find("Error.contrast.G"), nullptr);

  std::istringstream csv(bytes_of(out / "panels.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(
      line,
      "scene,sampler,estimator,policy,mode,thresholds,seed,pass,seconds,rays,samples,mean_spp,"
      "metric,value");
  int rows = 0;
  while (std::getline(csv, line)) {
    EXPECT_EQ(std::ranges::count(line, ','), 13) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 4 * 3 * 3);
}

TEST(CommandLineThreads, RenderIsTheSameWithAnyNumber) {
  const TempFolder folder;
  std::vector<ExrImage> images;
  for (const std::string threads : {"1", "2", "8"}) {
    const std::filesystem::path path = folder.path() / (threads + ".exr");
    const Result result =
        run({"render", "cornell-checker", "--size", "48x27", "--estimator", "kl", "--threshold",
             "0.004", "--passes", "5", "--threads", threads, "-o", path.string()});
    ASSERT_EQ(result.code, 0) << result.error;
    images.push_back(read_exr(path));
  }
  for (const ExrImage& image : images) {
    ASSERT_EQ(image.channels.size(), images[0].channels.size());
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
      EXPECT_TRUE(image.channels[c].pixels == images[0].channels[c].pixels)
          << image.channels[c].name;
    }
  }
}

TEST(CommandLine, RenderStopsAtItsConditions) {
  const TempFolder folder;
  const std::string path = (folder.path() / "x.exr").string();
  const auto samples = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"render", "cornell-box", "--size", "8x8", "-o", path};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words).code, 0);
    return std::stoi(read_exr(path).attributes.at("samples")) / 64;
  };
  EXPECT_EQ(samples({}), 15);
  EXPECT_EQ(samples({"--passes", "3"}), 3);
  EXPECT_EQ(samples({"--spp", "20"}), 20);
  EXPECT_EQ(samples({"--spp", "20", "--passes", "4"}), 4);
  EXPECT_EQ(samples({"--seconds", "1e-9"}), 1);
  EXPECT_EQ(samples({"--passes", "20", "--max-spp", "6"}), 6) << "no condition would ever be met";
}

TEST(CommandLine, ListWalksTheTables) {
  const Result text = run({"list"});
  EXPECT_EQ(text.code, 0);
  const auto json = nlohmann::json::parse(run({"list", "--json"}).out);
  ASSERT_EQ(json.at("estimators").size(), estimators().size());
  for (const Estimator& row : estimators()) {
    EXPECT_NE(text.out.find(row.source), std::string::npos);
  }
  EXPECT_GE(json.at("scenes").size(), 5u);
}

TEST(CommandLine, HelpAndVersion) {
  EXPECT_EQ(run({"--version"}).code, 0);
  for (const std::string command : {"figure", "render", "list"}) {
    const Result help = run({command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("Examples:"), std::string::npos);
  }
}

}  // namespace
}  // namespace quartet
