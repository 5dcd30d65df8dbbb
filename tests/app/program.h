#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "app/commands/command_line.h"

namespace quartet {

/// What a run of the program gave.
struct Result {
  int code;
  std::string out;
  std::string error;
};

/// The program with these arguments, in this process.
inline Result run(std::vector<std::string> words) {
  words.insert(words.begin(), "quartet");
  std::vector<const char*> argv;
  argv.reserve(words.size());
  for (const std::string& word : words) {
    argv.push_back(word.c_str());
  }
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = run_command_line(int(argv.size()), argv.data());
  std::fflush(stdout);
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

inline std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/// Wrong usage: exit code 2 and one line that holds `message`; nothing is written.
inline void expect_usage_error(const std::vector<std::string>& words, const std::string& message) {
  SCOPED_TRACE(message);
  const Result result = run(words);
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.error.find(message), std::string::npos) << result.error;
  EXPECT_EQ(std::ranges::count(result.error, '\n'), 1) << result.error;
  EXPECT_EQ(result.out, "");
}

}  // namespace quartet
