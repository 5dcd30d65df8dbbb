#pragma once

#include <dirent.h>

#include <cstring>
#include <memory>

namespace quartet {

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

/// Calls `look` with the name of each entry of a folder, and takes no memory from operator new:
/// where that runs out, the iterators of std::filesystem end the program, and what cleans up must
/// not fail. False if the folder cannot be read.
template <class Look>
bool each_entry(const char* path, const Look& look) {
  const std::unique_ptr<DIR, CloseFolder> folder(::opendir(path));
  if (!folder) {
    return false;
  }
  while (const dirent* const entry = ::readdir(folder.get())) {
    const char* const name = entry->d_name;
    if (std::strcmp(name, ".") != 0 && std::strcmp(name, "..") != 0) {
      look(name);
    }
  }
  return true;
}

}  // namespace quartet
