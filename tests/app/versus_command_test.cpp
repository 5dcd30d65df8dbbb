#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/program.h"
#include "tests/files/temp_folder.h"
#include "tests/records/csv.h"

namespace quartet {
namespace {

/// A cache of its own, so that tests neither read nor leave references elsewhere.
class VersusCommand : public testing::Test {
 protected:
  VersusCommand() { ::setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }
  ~VersusCommand() override { ::unsetenv("XDG_CACHE_HOME"); }

  static std::vector<std::string> versus(const std::string& a, const std::string& b,
                                         const std::vector<std::string>& more) {
    std::vector<std::string> words{"versus", a,     b,         "synthetic:bernoulli",
                                   "--size", "8x8", "--seeds", "3"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  TempFolder folder_;
};

TEST_F(VersusCommand, SaysWhatItFoundAsTextJsonAndCsv) {
  const std::string csv = (folder_.path() / "v.csv").string();
  const auto text = run(versus("kl:0.01", "uniform", {"--spp", "6", "--csv", csv}));
  ASSERT_EQ(text.code, 0) << text.error;
  EXPECT_NE(text.out.find("A: kl:0.01"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("energy"), std::string::npos);
  EXPECT_NE(text.out.find("3 seeds, sampler"), std::string::npos) << text.out;

  const auto json = run(versus("kl:0.01", "uniform", {"--spp", "6", "--json"}));
  ASSERT_EQ(json.code, 0) << json.error;
  const auto record = nlohmann::json::parse(json.out);
  EXPECT_EQ(record.at("seeds"), 3);
  EXPECT_EQ(record.at("effort"), "spp");
  EXPECT_EQ(record.at("B").at("lane"), "uniform");
  ASSERT_TRUE(record.at("ratios").contains("relmse_regions"));
  for (const char* lane : {"A", "B"}) {
    // The worst of 64 pixels: at least a 64th, and not all.
    const double top = record.at(lane).at("relmse_top_thousandth").get<double>();
    EXPECT_GT(top, 1.0 / 64.0);
    EXPECT_LT(top, 1.0);
  }

  const auto rows = rows_of(bytes_of(csv));
  std::map<std::string, int> found;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 14u);
    ++found[rows[i][2] + " " + rows[i][12]];
  }
  EXPECT_EQ(found["uniform relmse"], 3 * 6) << "each pass of each seed";
  EXPECT_EQ(found["uniform energy_error"], 3 * 6);
  EXPECT_EQ(found["uniform relmse_top_thousandth"], 3 * 6);
  EXPECT_EQ(found["kl relmse_at_goal"], 3);
  EXPECT_EQ(found["kl energy_error_at_goal"], 3);
}

TEST_F(VersusCommand, TheSentenceNamesALaneThatLosesLight) {
  // Samples above 4 are 0.9 % of all, and cut there the mean of 1 is 0.023 less; the interval is
  // less than half as wide.
  const auto result = run({"versus", "uniform-clamp", "uniform", "synthetic:pareto", "--size",
                           "64x64", "--seeds", "6", "--spp", "16"});
  ASSERT_EQ(result.code, 0) << result.error;
  EXPECT_NE(result.out.find("A is too dark: energy -2."), std::string::npos) << result.out;
}

TEST_F(VersusCommand, RefusesWhatCannotBeCompared) {
  const auto expect_refused = [](const std::vector<std::string>& words, const std::string& why) {
    const auto result = run(words);
    EXPECT_EQ(result.code, 2) << result.error;
    EXPECT_NE(result.error.find(why), std::string::npos) << result.error;
  };
  expect_refused(versus("kl", "kl", {}), "the same lane");
  expect_refused(versus("kl", "uniform", {"--metric", "psnr"}), "no ratio");
  expect_refused(versus("kl", "nothing", {}), "unknown estimator");
  expect_refused(versus("kl", "uniform", {"--rays", "9"}), "drawn, not traced");
  expect_refused(versus("kl", "uniform", {"--spp", "9", "--seconds", "1"}), "--spp");
}

}  // namespace
}  // namespace quartet
