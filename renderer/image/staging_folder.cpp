#include "renderer/image/staging_folder.h"

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

#include "renderer/system_calls.h"

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

/// The names of the files in a folder, without its folders.
std::vector<std::string> file_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (auto it = fs::directory_iterator(folder, ignored); it != fs::directory_iterator();
       it.increment(ignored)) {
    if (!it->is_directory(ignored) || it->is_symlink(ignored)) {
      names.push_back(it->path().filename().string());
    }
  }
  return names;
}

void remove_with_files(const fs::path& folder) {
  std::error_code ignored;
  for (const std::string& name : file_names(folder)) {
    fs::remove(folder / name, ignored);
  }
  fs::remove(folder, ignored);  // unless somebody has put a folder into it
}

void roll_forward(const fs::path& staging, const fs::path& parent, const std::string& last) {
  std::vector<std::string> names = file_names(staging);
  std::erase_if(names, [](const std::string& name) { return name.starts_with(backup_prefix); });
  std::ranges::stable_partition(names, [&](const std::string& name) { return name != last; });
  for (const std::string& name : names) {
    if (system_calls().rename((staging / name).c_str(), (parent / name).c_str()) != 0) {
      return;  // the next one may be able to
    }
  }
  sync_folder(parent);
  remove_with_files(staging);
}

void clear_if_dead(const fs::path& staging, const fs::path& parent, const std::string& last) {
  const int folder = open_folder(staging);
  if (folder < 0) {
    return;
  }
  if (is_mine(folder) && is_of_this_machine(folder) && ::flock(folder, LOCK_EX | LOCK_NB) == 0 &&
      is_at(folder, staging)) {
    if (staging.extension() == committing) {
      roll_forward(staging, parent, last);
    } else {
      remove_with_files(staging);
    }
  }
  ::close(folder);
}

}  // namespace

StagingFolder::StagingFolder(const fs::path& parent) : parent_(parent) {
  constexpr int tries = 100;
  for (int i = 0; i < tries; ++i) {
    path_ = parent / (random_name() + std::string(unfinished));
    if (system_calls().mkdir(path_.c_str(), 0700) != 0) {
      if (errno == EEXIST) {
        continue;
      }
      break;
    }
    leftover_.emplace(path_);
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
  std::error_code ignored;
  for (auto it = fs::directory_iterator(parent, ignored); it != fs::directory_iterator();
       it.increment(ignored)) {
    const fs::path name = it->path().filename();
    if (name.string().starts_with(staging_prefix) &&
        (name.extension() == unfinished || name.extension() == committing)) {
      found.push_back(it->path());
    }
  }
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
