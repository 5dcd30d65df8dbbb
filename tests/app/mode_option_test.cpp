#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "renderer/adaptive/estimators/estimator.h"
#include "renderer/adaptive/sample_mode.h"
#include "renderer/files/exr.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"
#include "tests/records/csv.h"

namespace quartet {
namespace {

class ModeOption : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void make_reference() const {
    const Result result =
        run({"reference", "cornell-box", "--size", "20x15", "--spp", "64", "-o", path("ref.exr")});
    ASSERT_EQ(result.code, 0) << result.error;
  }

  /// Each estimator in each mode, into a folder.
  void figure_of_all(const std::string& out, const std::string& threads) const {
    std::vector<std::string> words{
        "figure",    "cornell-box", "--size",      "20x15",         "--passes", "4",
        "--threads", threads,       "--reference", path("ref.exr"), "--out",    path(out)};
    for (const Estimator& row : estimators()) {
      for (const SampleModeRow& mode : sample_modes()) {
        words.emplace_back("--lane");
        words.push_back(fmt::format("{}:mode={}", row.id, mode.id));
      }
    }
    const Result result = run(words);
    ASSERT_EQ(result.code, 0) << result.error;
  }

  TempFolder folder_;
};

TEST_F(ModeOption, EachEstimatorInEachModeIsTheSameWithAnyNumberOfThreads) {
  make_reference();
  figure_of_all("1", "1");
  const auto csv = without_seconds(bytes_of(path("1/panels.csv")));
  ASSERT_GT(csv.size(), 2 * estimators().size());
  EXPECT_EQ(std::ranges::find(csv.front(), "seconds"), csv.front().end());
  const auto json = nlohmann::json::parse(bytes_of(path("1/panels.json")));
  ASSERT_EQ(json.at("lanes").size(), 2 * estimators().size());
  EXPECT_GT(json.at("pilot_store").at("samples_traced").get<int>(), 0);
  for (const std::string threads : {"2", "8"}) {
    figure_of_all(threads, threads);
    EXPECT_EQ(without_seconds(bytes_of(path(fmt::format("{}/panels.csv", threads)))), csv);
    for (const Estimator& row : estimators()) {
      for (const char* const suffix : {"", "-2"}) {
        const std::string name = fmt::format("{}{}.exr", row.id, suffix);
        const ExrImage one = read_exr(path(fmt::format("1/{}", name)));
        const ExrImage many = read_exr(path(fmt::format("{}/{}", threads, name)));
        ASSERT_EQ(one.channels.size(), many.channels.size());
        for (std::size_t c = 0; c < one.channels.size(); ++c) {
          EXPECT_TRUE(one.channels[c].pixels == many.channels[c].pixels)
              << name << " " << one.channels[c].name;
        }
      }
    }
  }
}

TEST_F(ModeOption, FilesSayTheModeAndWhatThePilotTook) {
  make_reference();
  const auto render = [&](const std::string& mode) {
    const Result result =
        run({"render", "cornell-box", "--size", "20x15", "--estimator", "kl", "--passes", "4",
             "--mode", mode, "-o", path(fmt::format("{}.exr", mode))});
    EXPECT_EQ(result.code, 0) << result.error;
    return read_exr(path(fmt::format("{}.exr", mode)));
  };
  const ExrImage reuse = render("reuse");
  const ExrImage unbiased = render("unbiased");
  EXPECT_EQ(reuse.attributes.at("mode"), "reuse");
  EXPECT_EQ(reuse.attributes.at("pilotSamples"), "0");
  EXPECT_EQ(unbiased.attributes.at("mode"), "unbiased");
  const auto samples = std::stoull(unbiased.attributes.at("samples"));
  EXPECT_EQ(2 * std::stoull(unbiased.attributes.at("pilotSamples")), samples);
  double shown = 0.0;
  for (const float count : std::get<std::vector<float>>(unbiased.find("SampleCount")->pixels)) {
    shown += count;
  }
  EXPECT_EQ(2.0 * shown, double(samples));
}

TEST_F(ModeOption, WrongUsageIsOneLine) {
  const auto error = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"figure", "cornell-box", "--size",
                                   "20x15",  "--out",       path("out")};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = run(words);
    EXPECT_EQ(result.code, 2) << result.error;
    return result.error;
  };
  EXPECT_NE(error({"--mode", "honest"}).find("there are: reuse, unbiased"), std::string::npos);
  EXPECT_NE(error({"--lane", "kl:mode=honest"}).find("there are: reuse, unbiased"),
            std::string::npos);
  EXPECT_NE(error({"--estimators", "oracle"}).find("--reference: estimator 'oracle'"),
            std::string::npos);
  EXPECT_NE(error({"--policy", "batch", "--batch-samples", "70000"}).find("--batch-samples"),
            std::string::npos);
}

TEST_F(ModeOption, AShortMemoryIsToldOnce) {
  for (std::vector<std::string> words : std::vector<std::vector<std::string>>{
           {"render", "cornell-box", "--size", "60x40", "--spp", "64", "-o", path("a.exr")},
           {"screenshot", "cornell-box", "--render-size", "60x40", "--passes", "64", "-o",
            path("a.png")},
           {"bias", "cornell-box", "--size", "60x40", "--passes", "64", "--seeds", "2",
            "--estimators", "kl", "--out", path("bias")},
           {"claims", "--size", "96x54", "--seeds", "1", "--reference-spp", "8"}}) {
    SCOPED_TRACE(words.front());
    const std::string enough = run(words).error;
    EXPECT_EQ(enough.find("outgrew"), std::string::npos) << enough;
    words.insert(words.end(), {"--memory", "0.001"});
    const Result result = run(words);
    ASSERT_EQ(result.code, 0) << result.error;
    const std::size_t told = result.error.find("outgrew --memory");
    ASSERT_NE(told, std::string::npos) << result.error;
    EXPECT_EQ(result.error.find("outgrew", told + 8), std::string::npos);
  }
}

}  // namespace
}  // namespace quartet
