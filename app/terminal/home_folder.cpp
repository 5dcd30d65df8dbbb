#include "app/terminal/home_folder.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace quartet {
namespace {

/// Of a user, or of the one who runs the program if `user` is empty; empty if it is not known.
std::string home_of(const std::string& user) {
  const char* const home = user.empty() ? std::getenv("HOME") : nullptr;
  if (home && *home) {
    return home;
  }
  passwd entry{};
  passwd* found = nullptr;
  std::array<char, 16384> buffer{};
  const int failed = user.empty()
                         ? getpwuid_r(getuid(), &entry, buffer.data(), buffer.size(), &found)
                         : getpwnam_r(user.c_str(), &entry, buffer.data(), buffer.size(), &found);
  return failed == 0 && found && found->pw_dir ? found->pw_dir : "";
}

}  // namespace

std::filesystem::path typed_path(const std::string& text) {
  if (!text.starts_with('~')) {
    return text;
  }
  const std::size_t slash = text.find('/');
  const std::string user = text.substr(1, slash == std::string::npos ? slash : slash - 1);
  const std::string home = home_of(user);
  if (home.empty()) {
    throw std::runtime_error(
        user.empty() ? fmt::format("{}: the home folder is not known (HOME is not set)", text)
                     : fmt::format("{}: there is no user '{}'; ./~{} is a file or folder of that "
                                   "name",
                                   text, user, user));
  }
  return home + (slash == std::string::npos ? "" : text.substr(slash));
}

}  // namespace quartet
