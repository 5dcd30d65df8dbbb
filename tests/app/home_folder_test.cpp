#include "app/terminal/home_folder.h"

#include <gtest/gtest.h>
#include <pwd.h>
#include <unistd.h>

#include <cstdlib>

#include "renderer/files/exr.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

/// $HOME is this, while it lives.
class HomeIs {
 public:
  explicit HomeIs(const char* home) {
    const char* const now = std::getenv("HOME");
    had_ = now != nullptr;
    before_ = had_ ? now : "";
    setenv("HOME", home, 1);
  }
  ~HomeIs() { had_ ? setenv("HOME", before_.c_str(), 1) : unsetenv("HOME"); }
  HomeIs(const HomeIs&) = delete;
  HomeIs& operator=(const HomeIs&) = delete;

 private:
  bool had_;
  std::string before_;
};

TEST(HomeFolder, ATildeIsTheHomeFolder) {
  const HomeIs home("/home/anna");
  EXPECT_EQ(typed_path("~"), "/home/anna");
  EXPECT_EQ(typed_path("~/figs/a b"), "/home/anna/figs/a b");
}

TEST(HomeFolder, OfAnotherUserToo) {
  const passwd* const me = getpwuid(getuid());
  ASSERT_NE(me, nullptr);
  const HomeIs home("/somewhere/else");
  const std::string folder = me->pw_dir;
  EXPECT_EQ(typed_path("~" + std::string(me->pw_name) + "/figs"), folder + "/figs");
  const std::string error = error_of([] { typed_path("~no-such-user/figs"); });
  EXPECT_NE(error.find("there is no user 'no-such-user'"), std::string::npos) << error;
}

TEST(HomeFolder, OtherPathsStayAsTheyAre) {
  for (const char* path : {"figs", "/tmp/~", "./~", "a~b", "", "../~/x"}) {
    EXPECT_EQ(typed_path(path), path);
  }
}

TEST(HomeFolder, AValueInTheSameWordAsItsOptionHasItToo) {
  const TempFolder folder;
  const HomeIs home(folder.path().c_str());
  const auto render = [](const std::string& output) {
    const Result result = run({"render", "synthetic:constant", "--size", "4x4", output});
    EXPECT_EQ(result.code, 0) << result.error;
  };
  render("--output=~/a.exr");
  render("-o~/b.exr");
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"a.exr", "b.exr"}));
  const std::string command = read_exr(folder / "a.exr").attributes.at("commandLine");
  EXPECT_NE(command.find((folder / "a.exr").string()), std::string::npos) << command;
  expect_usage_error({"figure", "synthetic:constant", "--out=~no-such-user/x"},
                     "--out=~no-such-user/x: there is no user 'no-such-user'");
}

TEST(HomeFolder, AWordThatTheShellLeftIsAName) {
  const Result result = run({"info", "~no-such-user"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.error.find("~no-such-user"), std::string::npos) << result.error;
  EXPECT_EQ(result.error.find("there is no user"), std::string::npos) << result.error;
}

}  // namespace
}  // namespace quartet
