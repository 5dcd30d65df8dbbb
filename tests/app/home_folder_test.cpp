#include "app/terminal/home_folder.h"

#include <gtest/gtest.h>
#include <pwd.h>
#include <unistd.h>

#include <cstdlib>

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

}  // namespace
}  // namespace quartet
