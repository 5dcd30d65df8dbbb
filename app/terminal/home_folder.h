#pragma once

#include <filesystem>
#include <string>

namespace quartet {

/// A path as people type it where no shell reads it: "~" and "~/figs" are in the home folder
/// ($HOME, else that of the system's list of users), "~anna/figs" in anna's. Throws
/// std::runtime_error if there is no such user or the home is not known; "./~" is a folder of that
/// name.
std::filesystem::path typed_path(const std::string& text);

}  // namespace quartet
