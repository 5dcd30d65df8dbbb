// How staged files get their names.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "renderer/image/staged_files.h"
#include "renderer/system_calls.h"

namespace quartet {

namespace fs = std::filesystem;

namespace {

/// Whether a process has the folder as its own: it would be left in one that is gone.
bool somebody_is_in(const fs::path& folder) {
  std::error_code error;
  for (auto it = fs::directory_iterator("/proc", error); it != fs::directory_iterator();
       it.increment(error)) {
    const std::string name = it->path().filename().string();
    std::error_code ignored;
    if (std::isdigit(static_cast<unsigned char>(name.front())) != 0 &&
        fs::equivalent(it->path() / "cwd", folder, ignored)) {
      return true;
    }
  }
  return bool(error);  // nobody can tell
}

/// Gives a new folder what the old one has; false if it has what cannot be given.
bool take_after(int made, const fs::path& old) {
  struct stat status {};
  if (::stat(old.c_str(), &status) != 0 || status.st_uid != ::geteuid()) {
    return false;
  }
  for (const char* list : {"system.posix_acl_access", "system.posix_acl_default"}) {
    if (::getxattr(old.c_str(), list, nullptr, 0) > 0) {
      return false;
    }
  }
  return ::fchown(made, uid_t(-1), status.st_gid) == 0 &&
         ::fchmod(made, status.st_mode & 07777) == 0;
}

/// What has come into the old folder while it was still the one of its name.
void rescue_strangers(const fs::path& old, const fs::path& folder) {
  std::error_code ignored;
  for (auto it = fs::directory_iterator(old, ignored); it != fs::directory_iterator();
       it.increment(ignored)) {
    const fs::path there = folder / it->path().filename();
    if (!fs::exists(fs::symlink_status(there, ignored))) {
      fs::rename(it->path(), there, ignored);
    }
  }
}

[[noreturn]] void fail_to_name(const fs::path& final, int error) {
  throw std::runtime_error(
      fmt::format("cannot write {}: {}", final.string(), std::generic_category().message(error)));
}

}  // namespace

/// Lets the staging folder and that of the final names change places, if nothing would be lost by
/// it. False if it did not.
bool StagedFiles::exchange_folder() {
  std::error_code error;
  const fs::path folder = fs::canonical(folder_, error);
  if (error || staged_.size() < 2 || stagings_.size() != 1 || folder == folder.root_path()) {
    return false;
  }
  StagingFolder& staging = *stagings_.front();
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool replaced = std::ranges::find(staged_, name, &Staged::name) != staged_.end() &&
                          entry.symlink_status(error).type() == fs::file_type::regular;
    if (!replaced && name != staging.path().filename()) {
      return false;
    }
  }
  if (error || somebody_is_in(folder) || !take_after(staging.descriptor(), folder)) {
    return false;
  }
  const fs::path inside = staging.path().parent_path();
  if (system_calls().fsync(staging.descriptor()) != 0 || !staging.move_to(folder.parent_path())) {
    return false;
  }
  // Locked by this process already, as the folder that is written to: nobody takes the old one for
  // that of a dead writer.
  if (system_calls().exchange(staging.path().c_str(), folder.c_str()) != 0) {
    if (!staging.move_to(inside)) {
      fail_to_name(folder, errno);
    }
    return false;
  }
  sync_folder(folder.parent_path());
  rescue_strangers(staging.path(), folder);
  return true;
}

/// One after the other, the list of a set as the last.
void StagedFiles::rename_each() {
  const SystemCalls& calls = system_calls();
  const bool set = staged_.size() > 1;
  for (Staged& file : staged_) {
    std::error_code ignored;
    file.replaces = fs::exists(file.final, ignored);
    if (set && file.replaces) {
      // Without one, an error later cannot be taken back: not all disks have links.
      static_cast<void>(calls.link(file.final.c_str(), file.backup().c_str()) == 0);
    }
  }
  for (std::size_t i = 0; set && i < stagings_.size(); ++i) {
    if (!stagings_[i]->begin_commit()) {
      const int error = errno;
      take_back(0);
      fail_to_name(stagings_[i]->parent(), error);
    }
  }
  for (std::size_t i = 0; i < staged_.size(); ++i) {
    if (calls.rename(staged_[i].temporary().c_str(), staged_[i].final.c_str()) != 0) {
      const int error = errno;
      take_back(i);
      fail_to_name(staged_[i].final, error);
    }
  }
  for (const auto& staging : stagings_) {
    sync_folder(staging->parent());
  }
}

/// Undoes the first `renamed` renames. If that is not possible either, the rest is left to the next
/// program, as after a sudden end.
void StagedFiles::take_back(std::size_t renamed) {
  bool undone = true;
  for (std::size_t i = renamed; i-- > 0;) {
    const Staged& file = staged_[i];
    const int result = file.replaces ? std::rename(file.backup().c_str(), file.final.c_str())
                                     : ::unlink(file.final.c_str());
    undone = undone && result == 0;
  }
  for (const auto& staging : stagings_) {
    if (undone) {
      staging->give_up_commit();
    } else {
      staging->leave();
    }
  }
}

}  // namespace quartet
