#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "renderer/files/exr.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"
#include "tests/records/csv.h"

namespace quartet {
namespace {

/// The commands bias and stability.
class StudyCommands : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static std::vector<std::string> with(std::vector<std::string> words,
                                       const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static std::vector<std::string> bias(const std::vector<std::string>& more) {
    return with({"bias", "cornell-box", "--size", "12x9", "--passes", "3", "--seeds", "2"}, more);
  }
  static std::vector<std::string> stability(const std::vector<std::string>& more) {
    return with({"stability", "--cases", "bernoulli", "--estimators", "kl", "--seeds", "2"}, more);
  }

  TempFolder folder_;
};

TEST_F(StudyCommands, BiasIsTheSameWithAnyNumberOfThreads) {
  // Two lanes of one estimator have channels of their own.
  const std::vector<std::string> lanes{"--lane", "kl:0.005", "--lane", "kl:0.05"};
  std::vector<std::vector<std::string>> csv;
  ExrImage exr;
  for (const std::string threads : {"1", "2", "8"}) {
    const Result result = run(bias(with(lanes, {"--threads", threads, "--out", path(threads)})));
    ASSERT_EQ(result.code, 0) << result.error;
    const ExrImage here = read_exr(path(threads) + "/bias.exr");
    if (threads == "1") {
      csv = without_seconds(bytes_of(path("1/bias.csv")));
      exr = here;
      EXPECT_EQ(names_in(path("1")), (std::set<std::string>{"bias.png", "bias.pdf", "bias.exr",
                                                            "bias.csv", "quartet-files.txt"}));
      EXPECT_EQ(exr.channels.size(), 3u + 2 * 4);
      // Four policies and modes: two seeds, and five numbers over both.
      EXPECT_EQ(csv.size(), 1u + 4 * (2 + 5));
    }
    EXPECT_EQ(without_seconds(bytes_of(path(threads) + "/bias.csv")), csv);
    ASSERT_EQ(here.channels.size(), exr.channels.size());
    for (std::size_t c = 0; c < exr.channels.size(); ++c) {
      EXPECT_TRUE(here.channels[c].pixels == exr.channels[c].pixels) << exr.channels[c].name;
    }
  }
}

TEST_F(StudyCommands, StabilityIsTheSameWithAnyNumberOfThreads) {
  std::vector<std::vector<std::string>> summary;
  std::vector<std::vector<std::string>> trials;
  for (const std::string threads : {"1", "2", "8"}) {
    const Result result = run(stability({"--threads", threads, "--out", path(threads)}));
    ASSERT_EQ(result.code, 0) << result.error;
    if (threads == "1") {
      summary = without_seconds(bytes_of(path("1/stability.csv")));
      trials = without_seconds(bytes_of(path("1/trials.csv")));
      EXPECT_EQ(names_in(path("1")),
                (std::set<std::string>{"matrix.png", "matrix.pdf", "stability.csv", "trials.csv",
                                       "quartet-files.txt"}));
      EXPECT_GT(summary.size(), 40u);
      EXPECT_GT(trials.size(), 100u);
    }
    EXPECT_EQ(without_seconds(bytes_of(path(threads) + "/stability.csv")), summary);
    EXPECT_EQ(without_seconds(bytes_of(path(threads) + "/trials.csv")), trials);
  }
}

TEST_F(StudyCommands, WhatIsNamedTwiceIsStudiedOnce) {
  const Result once = run(stability({"--out", path("once")}));
  const Result twice = run({"stability", "--cases", "bernoulli,bernoulli", "--estimators", "kl,kl",
                            "--seeds", "2", "--out", path("twice")});
  ASSERT_EQ(twice.code, 0) << twice.error;
  EXPECT_EQ(without_seconds(bytes_of(path("twice/stability.csv"))),
            without_seconds(bytes_of(path("once/stability.csv"))));
}

TEST_F(StudyCommands, RejectedSamplesAreToldInOneLine) {
  for (const auto& words :
       {std::vector<std::string>{"bias", "synthetic:non-finite", "--estimators", "kl", "--passes",
                                 "4", "--seeds", "2", "--out", path("bias")},
        std::vector<std::string>{"stability", "--cases", "non-finite,bernoulli", "--estimators",
                                 "kl", "--seeds", "2", "--out", path("stability")}}) {
    SCOPED_TRACE(words.front());
    const Result result = run(words);
    ASSERT_EQ(result.code, 0) << result.error;
    const std::size_t told = result.error.find("samples were NaN, infinite or negative");
    ASSERT_NE(told, std::string::npos) << result.error;
    EXPECT_EQ(result.error.find("samples were", told + 8), std::string::npos) << result.error;
    // The command that it names shows one of them.
    const std::size_t command = result.error.find("quartet trace ");
    std::istringstream rest(result.error.substr(command + 8));
    std::vector<std::string> trace;
    for (std::string word; rest >> word;) {
      trace.push_back(word);
    }
    const Result shown = run(trace);
    EXPECT_EQ(shown.code, 0) << shown.error;
    EXPECT_TRUE(shown.out.find("nan") != std::string::npos ||
                shown.out.find("inf") != std::string::npos ||
                shown.out.find(" -") != std::string::npos)
        << shown.out;
  }
}

TEST_F(StudyCommands, WrongUsageIsOneLine) {
  const std::vector<std::string> out{"--out", path("out")};
  for (const char* value : {"0", "-1", "nan", "many"}) {
    for (const char* option : {"--passes", "--seeds", "--confidence"}) {
      expect_usage_error(bias(with(out, {option, value})), option);
    }
    expect_usage_error(bias(with(out, {"--lane", std::string("kl:") + value})), "--lane");
    for (const char* option : {"--seeds", "--spp", "--truth-spp", "--confidence"}) {
      expect_usage_error(stability(with(out, {option, value})), option);
    }
  }
  expect_usage_error(bias(with(out, {"--estimators", "oracle"})), "bias is measured without one");
  expect_usage_error(bias(with(out, {"--seed", "18446744073709551615"})), "--seed");
  expect_usage_error(stability(with(out, {"--policy", "vote"})), "none meets the budget");
  expect_usage_error(stability(with(out, {"--policy", "none"})), "there are: vote");
  expect_usage_error({"stability", "--cases", "none", "--out", path("out")}, "there are: black");
  expect_usage_error({"stability", "--estimators", "oracle", "--out", path("out")},
                     "what the others are compared with");
  expect_usage_error(bias({}), "--out");
  EXPECT_EQ(names_in(folder_.path()), std::set<std::string>());
}

TEST_F(StudyCommands, AFolderThatCannotBeMadeIsOneLine) {
  for (const auto& words :
       {bias({"--out", "/dev/null/out"}), stability({"--out", "/dev/null/out"})}) {
    SCOPED_TRACE(words.front());
    const Result result = run(words);
    EXPECT_EQ(result.code, 1);
    EXPECT_EQ(std::ranges::count(result.error, '\n'), 1) << result.error;
    EXPECT_NE(result.error.find("/dev/null/out"), std::string::npos) << result.error;
  }
}

}  // namespace
}  // namespace quartet
