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

#include "renderer/base/system_calls.h"
#include "renderer/files/folder_entries.h"
#include "renderer/files/staged_files.h"

namespace quartet {

namespace fs = std::filesystem;

namespace {

/// Whether a process has the folder as its own: it would be left in one that is gone.
bool somebody_is_in(const fs::path& folder) {
  struct stat wanted {};
  bool found = ::stat(folder.c_str(), &wanted) != 0;
  const bool known = each_entry("/proc", [&](const std::string& process) {
    struct stat own {};
    found = found || (std::isdigit(static_cast<unsigned char>(process.front())) != 0 &&
                      ::stat(("/proc/" + process + "/cwd").c_str(), &own) == 0 &&
                      own.st_dev == wanted.st_dev && own.st_ino == wanted.st_ino);
  });
  return found || !known;
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

/// What has come into the old folder while it was still the one of its name. Takes no memory.
void rescue_strangers(const fs::path& old, const fs::path& folder) {
  const int from = ::open(old.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int to = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  each_entry(old.c_str(), [&](const char* name) {
    static_cast<void>(::renameat2(from, name, to, name, RENAME_NOREPLACE) == 0);
  });
  ::close(from);
  ::close(to);
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
  bool replaced = true;
  const bool readable = each_entry(folder.c_str(), [&](const std::string& name) {
    struct stat status {};
    replaced =
        replaced && (name == staging.path().filename() ||
                     (std::ranges::find(staged_, name, &Staged::name) != staged_.end() &&
                      ::lstat((folder / name).c_str(), &status) == 0 && S_ISREG(status.st_mode)));
  });
  if (!readable || !replaced || somebody_is_in(folder) ||
      !take_after(staging.descriptor(), folder)) {
    return false;
  }
  const fs::path inside = staging.path().parent_path();
  const fs::path around = folder.parent_path();
  if (system_calls().fsync(staging.descriptor()) != 0 || !staging.move_to(around)) {
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
  // From here on nothing may fail.
  sync_folder(around);
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
      const fs::path backup = file.staging->path() / backup_name(file.name);
      static_cast<void>(calls.link(file.final.c_str(), backup.c_str()) == 0);
    }
  }
  std::size_t renamed = 0;
  try {
    for (const auto& staging : stagings_) {
      if (set && !staging->begin_commit()) {
        fail_to_name(staging->parent(), errno);
      }
    }
    for (Staged& file : staged_) {
      file.source = file.temporary();
      file.backup = file.staging->path() / backup_name(file.name);
    }
    for (const Staged& file : staged_) {
      if (calls.rename(file.source.c_str(), file.final.c_str()) != 0) {
        fail_to_name(file.final, errno);
      }
      ++renamed;
    }
  } catch (...) {
    take_back(renamed);
    throw;
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
    const int result = file.replaces ? std::rename(file.backup.c_str(), file.final.c_str())
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
