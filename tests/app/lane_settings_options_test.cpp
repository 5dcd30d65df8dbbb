// What can be said of lane settings, and that nothing is said in vain.

#include "app/options/lane_settings_options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "app/options/lane_option.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

using LaneWords = std::set<std::string>;

/// By policy, what is read of a lane's words beside policy, mode and max-spp.
const std::map<std::string, LaneWords> read_under{{"vote", {"multiplier", "stochastic-rounding"}},
                                                  {"two-level", {"first", "batch"}},
                                                  {"batch", {"first", "batch"}},
                                                  {"converge", {"first", "batch"}}};

const std::map<std::string, std::string> value_of_word{
    {"multiplier", "multiplier=2"},
    {"stochastic-rounding", "stochastic-rounding"},
    {"first", "first=3"},
    {"batch", "batch=5"}};

/// The same as an option for all lanes.
LaneSettingsOptions option_of(const std::string& word) {
  const std::string& text = value_of_word.at(word);
  const auto row = std::ranges::find(lane_words(), word, &LaneWord::word);
  LaneSettingsOptions options;
  EXPECT_EQ(row->read(text.substr(text.find('=') + 1), options), "");
  return options;
}

std::string error_with(const LaneOptions& lanes, const LaneSettingsOptions& options,
                       const StopConditions& stop = {}) {
  return error_of([&] { settings_of_lanes(lanes, options, stop); });
}

TEST(LaneSettingsOptions, WhatThePolicyDoesNotReadIsRefused) {
  ASSERT_EQ(policies().size(), read_under.size());
  for (const auto& [policy, reads] : read_under) {
    for (const auto& [word, value] : value_of_word) {
      for (const Estimator& row : estimators()) {
        SCOPED_TRACE(fmt::format("{} under {} with {}", row.id, policy, value));
        const bool read = row.channels > 0 && reads.contains(word);
        LaneSettingsOptions options = option_of(word);
        options.policy = row.channels > 0 ? policy : "";
        const std::string error = error_with({{std::string(row.id)}, {}}, options);
        EXPECT_EQ(error.empty(), read) << error;
        if (!read) {
          EXPECT_NE(error.find(fmt::format("--{}", word)), std::string::npos) << error;
          EXPECT_NE(error.find("has no effect"), std::string::npos) << error;
          EXPECT_NE(
              error.find(word == "first" || word == "batch" ? "policies two-level, batch, converge"
                                                            : "policy vote"),
              std::string::npos)
              << error;
        }
        const std::string lane = row.channels > 0
                                     ? fmt::format("{}:policy={},{}", row.id, policy, value)
                                     : fmt::format("{}:{}", row.id, value);
        const std::string lane_error = error_with({{}, {lane}}, {});
        EXPECT_EQ(lane_error.empty(), read) << lane_error;
        if (!read) {
          EXPECT_NE(lane_error.find("--lane: " + word), std::string::npos) << lane_error;
        }
      }
    }
  }
}

TEST(LaneSettingsOptions, UniformHasNoPolicy) {
  LaneSettingsOptions options;
  options.policy = "batch";
  EXPECT_NE(error_with({{"uniform"}, {}}, options).find("--policy has no effect"),
            std::string::npos);
  EXPECT_NE(error_with({{}, {"uniform:policy=batch"}}, {}).find("policy has no effect"),
            std::string::npos);
  EXPECT_EQ(error_with({{"uniform", "kl"}, {}}, options), "");
}

TEST(LaneSettingsOptions, OneLaneOfSeveralThatReadsItIsEnough) {
  EXPECT_EQ(error_with({{"kl", "cycles"}, {}}, option_of("multiplier")), "");
  EXPECT_EQ(error_with({{"kl", "cycles"}, {}}, option_of("first")), "");
  EXPECT_NE(error_with({{"kl", "chi2"}, {}}, option_of("first")), "");
  // It has its own.
  EXPECT_NE(error_with({{}, {"kl:multiplier=1", "cycles"}}, option_of("multiplier"))
                .find("has its own multiplier"),
            std::string::npos);
  EXPECT_EQ(error_with({{}, {"kl:multiplier=1", "chi2"}}, option_of("multiplier")), "");
}

TEST(LaneSettingsOptions, ALaneIsReadWordByWord) {
  for (const std::string lane :
       {"kl:multiplier=1,multiplier=2", "kl:mode=reuse,mode=unbiased", "kl:stochastic-rounding=1",
        "kl:multiplier", "kl:max-spp=0", "kl:max-spp=2147483648", "kl:multiplier=1001",
        "cycles:first=65536", "cycles:batch=1e2", "kl:+1", "kl:1e31",
        ("kl:stochastic-rounding,"
         "stochastic-rounding")}) {
    EXPECT_NE(error_with({{}, {lane}}, {}).find("--lane: '" + lane), std::string::npos) << lane;
  }
}

TEST(LaneSettingsOptions, AsManySamplesAsAreAskedForCanBeTaken) {
  const auto most = [](const StopConditions& stop, const LaneSettingsOptions& options = {},
                       const std::string& lane = "uniform") {
    return settings_of_lanes({{}, {lane}}, options, stop).front().max_spp;
  };
  const std::uint32_t usual = LaneSettings().max_spp;
  EXPECT_EQ(most({}), usual);
  EXPECT_EQ(most({.spp = usual}), usual);
  EXPECT_EQ(most({.spp = usual + 1.0}), most_spp);
  EXPECT_EQ(most({.passes = usual + 1}), most_spp);
  LaneSettingsOptions capped;
  capped.max_spp = 100;
  EXPECT_EQ(most({.passes = usual + 1}, capped), 100u);
  EXPECT_EQ(most({.passes = usual + 1}, {}, "uniform:max-spp=70"), 70u);
}

TEST(LaneSettingsOptions, ContradictionsAreRefused) {
  LaneSettingsOptions options;
  options.max_spp = 6;
  EXPECT_NE(error_with({{"kl"}, {}}, options, {.spp = 20.0}).find("--max-spp 6"),
            std::string::npos);
  EXPECT_EQ(error_with({{"kl"}, {}}, options, {.spp = 6.0}), "");
  options.mode = "unbiased";  // twice the samples
  EXPECT_EQ(error_with({{"kl"}, {}}, options, {.spp = 12.0}), "");
  options.given = {PolicyParameterId::first};
  options.parameters.first = 7;
  EXPECT_NE(error_with({{"cycles"}, {}}, options).find("--first-samples 7"), std::string::npos);
}

TEST(LaneSettingsOptions, WhatIsCappedIsTold) {
  const TempFolder folder;
  const auto said = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"render", "cornell-box", "--size",
                                   "8x8",    "-o",          (folder / "a.exr").string()};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = run(words);
    EXPECT_EQ(result.code, 0) << result.error;
    return result.error;
  };
  EXPECT_EQ(said({"--passes", "3"}), "");
  EXPECT_EQ(said({"--passes", "9", "--max-spp", "6"}),
            "quartet: uniform ended after 6 passes, at 6.00 mean spp, before --passes 9: no pixel "
            "may have another sample; 64 of 64 have the 6 that --max-spp allows\n");
  EXPECT_EQ(
      said({"--estimator", "kl", "--threshold", "1e9", "--policy", "two-level", "--spp", "30"}),
      "quartet: kl ended after 1 passes, at 1.00 mean spp, before --spp 30: no pixel wants "
      "another sample\n");
}

TEST(LaneSettingsOptions, StudiesTellOfWhatIsCapped) {
  const TempFolder folder;
  const std::string capped = "64 of 64 pixels have the 6 samples that --max-spp allows\n";
  for (std::vector<std::string> words : std::vector<std::vector<std::string>>{
           {"bias", "cornell-box", "--estimators", "kl", "--passes", "9", "--seeds", "2", "--out",
            (folder / "bias").string()},
           {"sweep", "cornell-box", "--estimators", "kl", "--passes", "9", "--spp", "6", "--seeds",
            "1", "--thresholds", "1", "--reference-spp", "2", "--out", (folder / "sweep").string()},
           {"calibrate", "cornell-box", "--estimators", "kl", "--passes", "9", "--spp", "6"}}) {
    SCOPED_TRACE(words.front());
    words.insert(words.end(), {"--size", "8x8"});
    Result result = run(words);
    EXPECT_EQ(result.error.find("--max-spp allows"), std::string::npos) << result.error;
    words.insert(words.end(), {"--max-spp", "6"});
    result = run(words);
    const std::size_t told = result.error.find(capped);
    ASSERT_NE(told, std::string::npos) << result.error;
    EXPECT_EQ(result.error.find("--max-spp allows", told + capped.size()), std::string::npos);
  }
}

}  // namespace
}  // namespace quartet
