// Numbers on the command line: every numeric option of every command, found in the help, refuses
// what is no number in its range.

#include "app/options/number_option.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "tests/app/program.h"

namespace quartet {
namespace {

struct NumericOption {
  std::string command;  ///< empty: the program itself
  std::string name;
  bool whole;
  std::string low;
  std::string high;
};

std::vector<std::string> commands_of_help() {
  std::vector<std::string> commands;
  std::istringstream lines(run({"--help"}).out);
  bool below = false;
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    below = below || line == "Subcommands:";
    // Below the commands stand examples.
    if (below && std::regex_search(line, found, std::regex("^  ([a-z]+) ")) &&
        found[1] != "quartet") {
      commands.push_back(found[1]);
    }
  }
  return commands;
}

/// Those that the help says take a number.
std::vector<NumericOption> numeric_options() {
  std::vector<std::string> commands = commands_of_help();
  commands.emplace_back();
  std::vector<NumericOption> options;
  for (const std::string& command : commands) {
    std::vector<std::string> words{"--help"};
    if (!command.empty()) {
      words.insert(words.begin(), command);
    }
    std::istringstream lines(run(words).out);
    for (std::string line; std::getline(lines, line);) {
      // CLI11's own conversions, which wrap around and take octal numbers, have these names.
      EXPECT_FALSE(std::regex_search(line, std::regex("--[a-z-]+ (INT|UINT|FLOAT)"))) << line;
      std::smatch found;
      // The first of its names is the one that messages have.
      if (std::regex_search(line, found,
                            std::regex("(--[a-z-]+)(?:,--[a-z-]+)* (WHOLE|NUMBER):([-+.e0-9]+) to "
                                       "([-+.e0-9]+)"))) {
        options.push_back({command, found[1], found[2] == "WHOLE", found[3], found[4]});
      }
    }
  }
  return options;
}

/// What the option must not take. All kinds of words for one command, which has most options; they
/// are made by one function for all.
std::vector<std::string> bad_words(const NumericOption& option) {
  std::vector<std::string> words{"nan", "-1e39"};
  if (option.whole) {
    words.insert(words.end(), {"-1", "1.5", "18446744073709551616"});
    if (const long long low = std::stoll(option.low); low > 0) {
      words.push_back(std::to_string(low - 1));
    }
    if (option.high != "18446744073709551615") {
      words.push_back(std::to_string(std::stoll(option.high) + 1));
    }
  }
  if (option.command == "render") {
    words.insert(words.end(), {"inf", "-inf", "1e400", "-1e400", "1e39", "many", "0x10", "+5", " 5",
                               "5 ", "5e", "5_000"});
  }
  if (option.command == "render" && option.whole) {
    words.insert(words.end(),
                 {"5.0", "1e3", "-18446744073709551615", "99999999999999999999999999"});
  }
  return words;
}

/// As many of it, separated by commas, as an option takes.
std::string repeated(const std::string& word, const std::string& option) {
  const int count = option == "--pixel" ? 2 : option == "--camera" ? 12 : 1;
  std::string text = word;
  for (int i = 1; i < count; ++i) {
    text += "," + word;
  }
  return text;
}

TEST(NumberOption, EveryOneOfEveryCommandRefusesWhatIsOutOfItsRange) {
  const std::vector<NumericOption> options = numeric_options();
  std::map<std::string, int> count;
  for (const NumericOption& option : options) {
    ++count[option.command];
    for (const std::string& word : bad_words(option)) {
      SCOPED_TRACE(option.command + " " + option.name + " '" + word + "'");
      std::vector<std::string> words{option.name, repeated(word, option.name)};
      if (!option.command.empty()) {
        words.insert(words.begin(), option.command);
      }
      const Result result = run(words);
      EXPECT_EQ(result.code, 2);
      EXPECT_NE(result.error.find(option.name + ": '" + word + "' is not a "), std::string::npos)
          << result.error;
      EXPECT_NE(result.error.find(option.low + " to " + option.high), std::string::npos)
          << result.error;
      EXPECT_EQ(std::ranges::count(result.error, '\n'), 1) << result.error;
    }
  }
  // Where the help cannot be read, nothing would be tried.
  EXPECT_GE(count["render"], 13);
  EXPECT_GE(count["stability"], 5);
  EXPECT_EQ(count["trace"], 5);
  EXPECT_EQ(count[""], 1);
}

TEST(NumberOption, IsDecimalAndWhole) {
  constexpr NumberRange<std::uint64_t> all{0, std::numeric_limits<std::uint64_t>::max()};
  EXPECT_EQ(number_in("010", all), 10u);
  EXPECT_EQ(number_in("18446744073709551615", all), all.high);
  EXPECT_EQ(number_in("-0", all), std::nullopt);
  constexpr NumberRange<float> floats{-2.0f, 1e6f};
  EXPECT_EQ(number_in("-1.5", floats), -1.5f);
  EXPECT_EQ(number_in("1e3", floats), 1000.0f);
  EXPECT_EQ(number_in("0,5", floats), std::nullopt);
  EXPECT_EQ(number_in("", floats), std::nullopt);
}

TEST(NumberOption, SizesSayTheirRange) {
  for (const std::string size : {"-1x5", "99999999999x1", "0x5", "5x", "x5", "5x5x5", " 5x5",
                                 "+5x5", "5.0x5", "1e3x5", "16777217x1"}) {
    expect_usage_error({"render", "cornell-box", "-o", "a.exr", "--size", size},
                       "--size: '" + size + "' is not a size");
    expect_usage_error({"screenshot", "cornell-box", "-o", "a.png", "--size", size},
                       "1 to 16777216");
    expect_usage_error({"screenshot", "cornell-box", "-o", "a.png", "--render-size", size},
                       "--render-size: '" + size);
  }
}

}  // namespace
}  // namespace quartet
