// What goes out of the program: streams, files, CSV; and what is known of it before any work.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>

#include "app/options/lane_option.h"
#include "app/records/csv_field.h"
#include "app/records/lab_files.h"
#include "renderer/base/printable.h"
#include "renderer/files/exr.h"
#include "renderer/files/staged_files.h"
#include "renderer/view/lane_exr.h"
#include "tests/app/ball_scene.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"
#include "tests/records/csv.h"
#include "ui/paper/lab_figure.h"

namespace quartet {
namespace {

/// The program in a process of its own, in this folder and without a display; its standard output
/// is a file, or closed if that has no name.
int code_of_process(const std::vector<std::string>& words, const std::filesystem::path& folder,
                    const char* output) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    std::vector<char*> argv{const_cast<char*>(QUARTET_PROGRAM)};
    for (const std::string& word : words) {
      argv.push_back(const_cast<char*>(word.c_str()));
    }
    argv.push_back(nullptr);
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    ::close(STDOUT_FILENO);
    if ((*output != '\0' && ::open(output, O_WRONLY) != STDOUT_FILENO) ||
        ::chdir(folder.c_str()) != 0) {
      ::_exit(126);
    }
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Output, WhatCannotBePrintedIsAFailure) {
  const TempFolder folder;
  const std::vector<std::vector<std::string>> commands{
      {"--help"},
      {"--version"},
      {"list"},
      {"info", "synthetic:constant"},
      {"render", "synthetic:constant", "--size", "4x4", "-o", "a.exr"}};
  for (const std::vector<std::string>& words : commands) {
    SCOPED_TRACE(words.front());
    EXPECT_EQ(code_of_process(words, folder.path(), "/dev/full"), 1);
    EXPECT_EQ(code_of_process(words, folder.path(), ""), 1);
    EXPECT_EQ(code_of_process(words, folder.path(), "/dev/null"), 0);
  }
  EXPECT_EQ(read_exr(folder / "a.exr").width(), 4) << "what was rendered is kept";
}

/// A scene of the size of a stamp, with a name of one's choice.
std::filesystem::path small_scene(const TempFolder& folder, const std::string& name) {
  std::filesystem::path path = folder / (name + ".xml");
  write_bytes_to(path, ball_scene(8, 8));
  return path;
}

TEST(Output, WithoutADisplayNothingIsReplaced) {
  const TempFolder folder;
  const std::string scene = small_scene(folder, "ball").string();
  std::filesystem::create_directory(folder / "out");  // an empty one is as good as none
  ASSERT_EQ(code_of_process({scene}, folder.path(), "/dev/null"), 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "images.png"));
  write_bytes_to(folder / "out" / "images.png", "mine");
  write_bytes_to(folder / "out-2", "a file");
  ASSERT_EQ(code_of_process({scene}, folder.path(), "/dev/null"), 0);
  EXPECT_EQ(bytes_of(folder / "out" / "images.png"), "mine");
  EXPECT_EQ(bytes_of(folder / "out-2"), "a file");
  EXPECT_TRUE(std::filesystem::exists(folder / "out-3" / "images.png"));
}

TEST(CsvField, IsQuotedWhereItWouldEndTheFieldOrTheRow) {
  EXPECT_EQ(csv_field("cornell-box"), "cornell-box");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("a\"b"), "\"a\"\"b\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_field("a\rb"), "\"a\rb\"");
}

/// The fields of each row, as RFC 4180 has it.
std::vector<std::vector<std::string>> parsed(const std::string& csv) {
  std::vector<std::vector<std::string>> rows{{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const char c = csv[i];
    if (quoted && c == '"' && i + 1 < csv.size() && csv[i + 1] == '"') {
      rows.back().back() += csv[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (quoted || (c != ',' && c != '\n')) {
      rows.back().back() += c;
    } else if (c == ',') {
      rows.back().emplace_back();
    } else {
      rows.push_back({""});
    }
  }
  rows.pop_back();  // after the last line's end
  return rows;
}

TEST(Output, EveryCsvTakesEveryNameOfAScene) {
  const TempFolder folder;
  const std::string name = "a,\"b\"\nc";
  const std::string scene = small_scene(folder, name).string();
  const std::string out = (folder / "out").string();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"figure", scene, "--passes", "1", "--out", out},
        std::vector<std::string>{"bias", scene, "--passes", "1", "--seeds", "2", "--estimators",
                                 "kl", "--out", out},
        std::vector<std::string>{"sweep", scene, "--passes", "1", "--thresholds", "1",
                                 "--estimators", "kl", "--reference-spp", "2", "--spp", "2",
                                 "--out", out}}) {
    const Result result = run(words);
    ASSERT_EQ(result.code, 0) << words.front() << result.error;
  }
  for (const std::string csv : {"panels.csv", "bias.csv", "sweep.csv", "calibration.csv"}) {
    SCOPED_TRACE(csv);
    const auto rows = parsed(bytes_of(folder / "out" / csv));
    ASSERT_GT(rows.size(), 1u);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].size(), rows[0].size());
      EXPECT_EQ(rows[i][0], printable(name));
    }
  }
}

TEST(Output, AFigureThatIsTooLargeIsRefusedBefore) {
  const TempFolder folder;
  const auto figure = [&](const std::string& size, std::vector<std::string> more = {}) {
    std::vector<std::string> words{"figure", "synthetic:constant",     "--size", size,
                                   "--out",  (folder / "out").string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  expect_usage_error(figure("16000x9"), "at most 32767x32767");
  expect_usage_error(figure("40000x9"), "at most 32767x32767");
  expect_usage_error(figure("9x17000"), "at most 32767x32767");
  std::vector<std::string> many{"figure", "synthetic:constant",     "--size", "9x1000",
                                "--out",  (folder / "out").string()};
  for (int i = 0; i < 64; ++i) {
    many.insert(many.end(), {"--lane", "kl"});
  }
  expect_usage_error(many, "64 panels");
  expect_usage_error(
      {"bias", "synthetic:constant", "--size", "16000x9", "--out", (folder / "out").string()},
      "at most 32767x32767");
  expect_usage_error(
      {"render", "synthetic:constant", "--size", "70000x1", "-o", (folder / "a.exr").string()},
      "--size: a picture of 70000 x 1 pixels");
  expect_usage_error({"reference", "synthetic:constant", "--size", "70000x1", "--spp", "2", "-o",
                      (folder / "a.exr").string()},
                     "--size: a picture of 70000 x 1 pixels");
  expect_usage_error(
      {"render", "synthetic:constant", "--size", "1000001x1", "-o", (folder / "a.png").string()},
      "--size: a picture of 1000001 x 1 pixels");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>());
}

TEST(Output, TheBoundOfAFigureHoldsWhateverItsTextsSay) {
  // As wide and as high as is let pass, and with the longest texts: Cairo takes it.
  for (const auto& [width, height] : {std::pair{15000, 2}, {2, 15000}}) {
    int most_width = width;
    int most_height = height;
    int& side = width > height ? most_width : most_height;
    const auto fits = [&] {
      return error_of([&] { check_figure_size("--size", most_width, most_height, 3, true); })
          .empty();
    };
    while (fits()) {
      side += 50;
    }
    side -= 50;
    ASSERT_GT(side, 10000);
    EXPECT_TRUE(fits());
    side += 2000;
    EXPECT_FALSE(fits());
  }
}

TEST(Output, CountsOfChannelsAndNamesOfFilesAreThoseThatAreWritten) {
  const TempFolder folder;
  const Result made = run({"reference", "synthetic:constant", "--size", "8x8", "--spp", "2", "-o",
                           (folder / "ref.exr").string()});
  ASSERT_EQ(made.code, 0) << made.error;
  const LaneOptions lanes{{}, {"contrast", "kl", "kl:0.1", "uniform"}};
  std::vector<std::string> words{"figure",      "synthetic:constant",
                                 "--size",      "8x8",
                                 "--passes",    "2",
                                 "--out",       (folder / "out").string(),
                                 "--reference", (folder / "ref.exr").string()};
  for (const std::string& lane : lanes.lanes) {
    words.insert(words.end(), {"--lane", lane});
  }
  const Result result = run(words);
  ASSERT_EQ(result.code, 0) << result.error;
  const auto lane_settings = settings_of_lanes(lanes, {}, {});
  const std::vector<std::string> names = lab_file_names(lane_settings);
  std::set<std::string> all(names.begin(), names.end());
  all.emplace(StagedFiles::set_list_name);
  EXPECT_EQ(names_in(folder / "out"), all);
  EXPECT_EQ(read_exr(folder / "out" / "contrast.exr").channels.size(), lane_exr_channels);
}

TEST(Output, NamesThatCannotBeWrittenAreRefusedBefore) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "out" / "kl-heatmap.png");
  std::filesystem::create_directory(folder / "a.exr");
  std::filesystem::create_directory(folder / "a.png");
  std::filesystem::create_directory(folder / "a.csv");
  ASSERT_EQ(::mkfifo((folder / "pipe.exr").c_str(), 0600), 0);
  const std::string out = (folder / "out").string();
  const std::string long_name = (folder / (std::string(260, 'x') + ".exr")).string();
  const auto in = [&](const std::string& name) { return (folder / name).string(); };
  // With more work than a test has time for: it must end before that.
  const std::vector<std::vector<std::string>> commands{
      {"figure", "cornell-box", "--passes", "1000000000", "--out", out},
      {"render", "cornell-box", "--passes", "1000000000", "-o", in("a.exr")},
      {"render", "cornell-box", "--passes", "1000000000", "-o", in("a.png")},
      {"render", "cornell-box", "--passes", "1000000000", "-o", in("pipe.exr")},
      {"render", "cornell-box", "--passes", "1000000000", "-o", long_name},
      {"screenshot", "cornell-box", "--passes", "1000000000", "-o", in("a.png")},
      {"reference", "cornell-box", "--spp", "4000000000", "-o", in("a.exr")},
      {"claims", "--size", "96x54", "--seeds", "10000", "--csv", in("a.csv")}};
  const std::set<std::string> before = names_in(folder.path());
  for (const std::vector<std::string>& words : commands) {
    SCOPED_TRACE(words.front() + " " + words.back());
    const Result result = run(words);
    EXPECT_EQ(result.code, 1);
    EXPECT_NE(result.error.find("cannot "), std::string::npos) << result.error;
    EXPECT_NE(result.error.find(folder.path().string()), std::string::npos) << result.error;
    EXPECT_EQ(std::ranges::count(result.error, '\n'), 1) << result.error;
  }
  EXPECT_EQ(names_in(folder.path()), before);
}

}  // namespace
}  // namespace quartet
