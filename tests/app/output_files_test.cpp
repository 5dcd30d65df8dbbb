// What commands write, and under which names.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "app/terminal/shell_words.h"
#include "renderer/files/exr.h"
#include "renderer/files/staged_files.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

TEST(ShellWords, AreTextWhateverTheyAreMadeOf) {
  EXPECT_EQ(shell_word("a.exr"), "a.exr");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("caf\xe9 it's\\"), "$'caf\\xe9 it\\'s\\\\'");
  EXPECT_EQ(shell_word("\x1b[31m\n"), "$'\\x1b[31m\\x0a'");
  EXPECT_EQ(shell_word("Übung"), "'Übung'");
}

TEST(OutputFiles, ASetIsOfOneRunInAFolderOfAnyName) {
  const TempFolder folder;
  const std::filesystem::path out = folder / "caf\xe9";
  const Result result = run({"figure", "cornell-box", "--size", "16x9", "--passes", "1",
                             "--estimators", "kl,uniform", "--out", out.string()});
  ASSERT_EQ(result.code, 0) << result.error;
  const auto json = nlohmann::json::parse(bytes_of(out / "panels.json"));
  EXPECT_NE(json.at("command_line").get<std::string>().find("caf\\xe9"), std::string::npos);
  const std::string set = json.at("run");
  EXPECT_EQ(read_exr(out / "kl.exr").attributes.at("run"), set);
  EXPECT_EQ(read_exr(out / "uniform.exr").attributes.at("run"), set);
  const std::string list = bytes_of(out / StagedFiles::set_list_name);
  EXPECT_NE(list.find("run " + set + "\n"), std::string::npos) << list;
  EXPECT_NE(list.find(" kl.exr\n"), std::string::npos) << list;
}

TEST(OutputFiles, WhatIsWriteProtectedIsRefusedBeforeTheWork) {
  const TempFolder folder;
  write_bytes_to(folder / "a.exr", "precious");
  std::filesystem::permissions(folder / "a.exr", std::filesystem::perms(0444));
  for (const char* command : {"render", "reference"}) {
    const Result result = run(
        {command, "cornell-box", "--size", "8x8", "--spp", "2", "-o", (folder / "a.exr").string()});
    EXPECT_EQ(result.code, 1);
    EXPECT_EQ(bytes_of(folder / "a.exr"), "precious");
  }
  const Result result = run({"render", "cornell-box", "--size", "8x8", "--spp", "1000000", "-o",
                             (folder / "a.exr").string()});
  EXPECT_NE(result.error.find("write-protected (mode 444)"), std::string::npos) << result.error;
}

TEST(OutputFiles, WhatCouldNotBeReadAgainIsRefusedBeforeTheWork) {
  const TempFolder folder;
  const std::string out = (folder / "a.exr").string();
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"render", "cornell-box", "--spp", "1", "-o", out},
           {"reference", "cornell-box", "--spp", "2", "-o", out},
           {"bias", "cornell-box", "--passes", "1", "--out", folder.path().string()}}) {
    std::vector<std::string> wide = words;
    wide.insert(wide.end(), {"--size", "65537x1"});
    const Result result = run(wide);
    EXPECT_EQ(result.code, 2);
    EXPECT_NE(result.error.find("each side must be from 1 to 65536"), std::string::npos)
        << result.error;
  }
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>());
}

}  // namespace
}  // namespace quartet
