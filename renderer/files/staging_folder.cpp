#include "renderer/files/staging_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <random>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "renderer/base/system_calls.h"
#include "renderer/files/folder_entries.h"

namespace quartet {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view staging_prefix = ".quartet-";
constexpr std::string_view unfinished = ".part";
constexpr std::string_view committing = ".commit";
constexpr std::string_view backup_prefix = ".old.";

// From <linux/magic.h> and, where the kernel's headers leave them out, from the file systems.
constexpr std::array<unsigned long, 12> local_file_systems{
    EXT4_SUPER_MAGIC, XFS_SUPER_MAGIC,   BTRFS_SUPER_MAGIC,     TMPFS_MAGIC,          RAMFS_MAGIC,
    F2FS_SUPER_MAGIC, MSDOS_SUPER_MAGIC, OVERLAYFS_SUPER_MAGIC, REISERFS_SUPER_MAGIC,
    0x2fc12fc1,  // ZFS
    0xca451a4e,  // bcachefs
    0x2011bab0,  // exFAT
};

/// An open folder, or a negative number.
int open_folder(const fs::path& path) {
  return ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

bool is_at(int folder, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(folder, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// Whether a lock on it says something about everybody who may write there.
bool is_of_this_machine(int folder) {
  struct statfs status {};
  return ::fstatfs(folder, &status) == 0 &&
         std::ranges::find(local_file_systems, static_cast<unsigned long>(status.f_type)) !=
             local_file_systems.end();
}

bool is_mine(int folder) {
  struct stat status {};
  return ::fstat(folder, &status) == 0 && status.st_uid == ::geteuid();
}

std::string random_name() {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::string name(staging_prefix);
  for (int i = 0; i < 12; ++i) {
    name += letters[random() % letters.size()];
  }
  return name;
}

/// Takes no memory: destructors call it.
void remove_with_files(const fs::path& folder) {
  const int opened = open_folder(folder);
  if (opened < 0) {
    return;
  }
  each_entry(folder.c_str(), [&](const char* name) { ::unlinkat(opened, name, 0); });
  ::close(opened);
  ::rmdir(folder.c_str());  // unless somebody has put a folder into it
}

void roll_forward(const fs::path& staging, const fs::path& parent, const std::string& last) {
  std::vector<std::string> names;
  each_entry(staging.c_str(), [&](const std::string& name) {
    if (!name.starts_with(backup_prefix)) {
      names.push_back(name);
    }
  });
  std::stable_partition(names.begin(), names.end(),
                        [&](const std::string& name) { return name != last; });
  for (const std::string& name : names) {
    if (system_calls().rename((staging / name).c_str(), (parent / name).c_str()) != 0) {
      return;  // the next one may be able to
    }
  }
  sync_folder(parent);
  remove_with_files(staging);
}

/// An open folder that is closed with its block.
class OpenedFolder {
 public:
  explicit OpenedFolder(const fs::path& path) : folder_(open_folder(path)) {}
  ~OpenedFolder() {
    if (folder_ >= 0) {
      ::close(folder_);
    }
  }
  OpenedFolder(const OpenedFolder&) = delete;
  OpenedFolder& operator=(const OpenedFolder&) = delete;

  int get() const { return folder_; }

 private:
  int folder_;
};

void clear_if_dead(const fs::path& staging, const fs::path& parent, const std::string& last) {
  const OpenedFolder folder(staging);
  if (folder.get() < 0 || !is_mine(folder.get()) || !is_of_this_machine(folder.get()) ||
      ::flock(folder.get(), LOCK_EX | LOCK_NB) != 0 || !is_at(folder.get(), staging)) {
    return;
  }
  if (staging.extension() == committing) {
    roll_forward(staging, parent, last);
  } else {
    remove_with_files(staging);
  }
}

}  // namespace

StagingFolder::StagingFolder(const fs::path& parent) : parent_(parent) {
  constexpr int tries = 100;
  for (int i = 0; i < tries; ++i) {
    path_ = parent / (random_name() + std::string(unfinished));
    leftover_.emplace(path_);
    if (system_calls().mkdir(path_.c_str(), 0700) != 0) {
      if (errno == EEXIST) {
        continue;
      }
      break;
    }
    folder_ = open_folder(path_);
    // Until it is locked, one that looks for the dead may take it for theirs.
    const bool taken =
        folder_ < 0 || (::flock(folder_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK);
    if (!taken && is_at(folder_, path_)) {
      return;
    }
    if (folder_ >= 0) {
      ::close(folder_);
      folder_ = -1;
    }
    ::rmdir(path_.c_str());
    leftover_.reset();
    errno = EAGAIN;
  }
  throw std::runtime_error(fmt::format("cannot write into the folder {}: {}", parent.string(),
                                       std::generic_category().message(errno)));
}

StagingFolder::~StagingFolder() {
  if (!left_) {
    remove_with_files(path_);
  }
  ::close(folder_);
}

bool StagingFolder::move_to(const fs::path& parent) {
  const fs::path there = parent / path_.filename();
  if (system_calls().rename(path_.c_str(), there.c_str()) != 0) {
    return false;
  }
  path_ = there;
  return true;
}

bool StagingFolder::begin_commit() {
  fs::path there = path_;
  there.replace_extension(committing);
  if (system_calls().fsync(folder_) != 0 && errno != EINVAL) {
    return false;
  }
  if (system_calls().rename(path_.c_str(), there.c_str()) != 0) {
    return false;
  }
  path_ = there;
  sync_folder(parent_);
  return true;
}

void StagingFolder::give_up_commit() {
  fs::path there = path_;
  there.replace_extension(unfinished);
  if (std::rename(path_.c_str(), there.c_str()) == 0) {
    path_ = there;
  }
}

void clear_dead_staging(const fs::path& parent, const std::string& last) {
  std::vector<fs::path> found;
  each_entry(parent.c_str(), [&](const fs::path& name) {
    if (name.string().starts_with(staging_prefix) &&
        (name.extension() == unfinished || name.extension() == committing)) {
      found.push_back(parent / name);
    }
  });
  for (const fs::path& staging : found) {
    clear_if_dead(staging, parent, last);
  }
}

std::string backup_name(const std::string& name) {
  return std::string(backup_prefix) + name;
}

FolderLock::FolderLock(const fs::path& folder) {
  constexpr auto step = std::chrono::milliseconds(10);
  for (int i = 0; i < 500; ++i) {
    if (folder_ < 0) {
      folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    }
    if (folder_ < 0) {
      return;
    }
    if (::flock(folder_, LOCK_EX | LOCK_NB) == 0) {
      struct stat opened {};
      struct stat named {};
      if (::fstat(folder_, &opened) == 0 && ::stat(folder.c_str(), &named) == 0 &&
          opened.st_ino == named.st_ino && opened.st_dev == named.st_dev) {
        return;
      }
      ::close(folder_);  // another has put a new folder in its place
      folder_ = -1;
      continue;
    }
    if (errno != EWOULDBLOCK && errno != EINTR) {
      return;
    }
    std::this_thread::sleep_for(step);
  }
}

FolderLock::~FolderLock() {
  if (folder_ >= 0) {
    ::close(folder_);
  }
}

void sync_folder(const fs::path& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened >= 0) {
    ::fsync(opened);
    ::close(opened);
  }
}

}  // namespace quartet
